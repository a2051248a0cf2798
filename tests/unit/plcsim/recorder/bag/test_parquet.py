from collections.abc import Iterator
from pathlib import Path

import pytest

from plcsim.recorder.bag import parquet
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.series import columns_of, rows_of
from plcsim.recorder.errors import RecordingError

from ..conftest import Fast, Recordings, application_of

pq = pytest.importorskip("pyarrow.parquet")


def test_every_cycle_is_a_row_and_values_keep_their_kind(
    recordings: Recordings, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parquet, "ROWS", 15)  # 40 rows in three parts
    with open_bag(recordings("a.bag", application_of(Fast))) as bag:
        head = bag.head()
        rows = rows_of(head, bag.records(), ["Fast"])
        parquet.write_parquet(tmp_path / "a.parquet", columns_of(head, ["Fast"]), rows)

    table = pq.read_table(tmp_path / "a.parquet")
    assert table.num_rows == 40
    assert {f.name: str(f.type) for f in table.schema} == {
        "time_s": "double",
        "task_class": "int64",
        "cycle": "int64",
        "Fast.count": "int64",
        "Fast.told": "int64",
        "Fast.doubled": "int64",
        "Fast.lamp": "bool",
        "Fast.name": "string",
    }
    assert table["Fast.count"].to_pylist() == list(range(1, 41))
    assert table["time_s"].to_pylist()[:3] == pytest.approx([0, 0.01, 0.02])


def test_a_place_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    def rows() -> Iterator[list[object]]:
        yield ["time_s", "task_class", "cycle"]
        yield [0.5, 1, 1]

    with pytest.raises(RecordingError, match=r"a\.parquet: cannot be written"):
        parquet.write_parquet(tmp_path / "none" / "a.parquet", [], rows())
