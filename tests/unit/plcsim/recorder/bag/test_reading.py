from pathlib import Path

import pytest

from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.reindex import reindex
from plcsim.recorder.errors import RecordingError

from ..conftest import Fast, Recordings, application_of
from .test_files import write


def test_the_variables_of_every_cycle_are_whole(recordings: Recordings) -> None:
    with open_bag(recordings("a.bag", application_of(Fast))) as bag:
        counts = [
            int.from_bytes(record.variables[:4], "little")
            for _, record in bag.records()
            if record.step == 0
        ]
    assert counts == list(range(1, 41))


@pytest.mark.parametrize("name", ["a.bag", "a.mcap", "a.db3"])
@pytest.mark.parametrize("part", [0, 10, 2000, 4200])
def test_a_truncated_bag_is_told(tmp_path: Path, name: str, part: int) -> None:
    write(tmp_path / name, count=100)
    data = (tmp_path / name).read_bytes()
    (tmp_path / name).write_bytes(data[: min(part, len(data) - 1)])

    with pytest.raises(RecordingError, match=name), open_bag(tmp_path / name) as bag:
        list(bag.messages())


def test_a_bag_without_an_index_is_told_with_what_makes_it_readable(tmp_path: Path) -> None:
    bag = tmp_path / "a.bag"
    write(bag, count=100)
    bag.write_bytes(bag.read_bytes()[:-10])

    hint = rf"{bag}: Bag index looks damaged: plcsim bag reindex {bag} --output a_reindexed\.bag"
    with pytest.raises(RecordingError, match=hint), open_bag(bag):
        pass
    reindex(bag, tmp_path / "a_reindexed.bag")
    with open_bag(tmp_path / "a_reindexed.bag") as found:
        assert len(list(found.messages())) == 100


@pytest.mark.parametrize("name", ["a.bag", "a.mcap", "a.db3"])
def test_a_file_that_is_no_bag_is_told(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_bytes(bytes(range(256)) * 100)

    with pytest.raises(RecordingError, match=name), open_bag(tmp_path / name) as bag:
        list(bag.messages())


def test_a_bag_of_others_has_no_head(tmp_path: Path) -> None:
    write(tmp_path / "a.bag")

    with open_bag(tmp_path / "a.bag") as bag, pytest.raises(RecordingError, match="not recorded"):
        bag.head()


def test_a_missing_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="no such file"), open_bag(tmp_path / "a.bag"):
        pass
