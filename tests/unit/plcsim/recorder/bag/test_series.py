import pytest

from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.series import Series, series_of
from plcsim.recorder.errors import RecordingError

from ..conftest import Fast, Recordings, application_of

MS = 1_000_000


def read(recordings: Recordings, *paths: str) -> list[Series]:
    with open_bag(recordings("a.bag", application_of(Fast), cycles=3)) as bag:
        return series_of(bag.head(), bag.records(), paths)


def test_a_tag_has_a_point_for_every_change_and_the_end(recordings: Recordings) -> None:
    lamp, told = read(recordings, "Fast.lamp", "fast.told")

    values = [True, False, True, False, True, False]
    assert lamp.points == [*((10 * n * MS, v) for n, v in enumerate(values)), (50 * MS, False)]
    assert told.points == [(0, 0), (50 * MS, 0)]


@pytest.mark.parametrize(
    ("path", "text"), [("Fast.lmap", "no tag"), ("Fast.name", "no number"), ("gone.x", "gone")]
)
def test_what_cannot_be_drawn_is_told(recordings: Recordings, path: str, text: str) -> None:
    with pytest.raises(RecordingError, match=text):
        read(recordings, path)
