import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.recorder.bag.changes import changed, changes
from plcsim.recorder.errors import RecordingError

_PAIRS = st.integers(1, 200).flatmap(
    lambda size: st.tuples(*[st.binary(min_size=size, max_size=size)] * 2)
)


@given(_PAIRS)
def test_changes_make_the_later_of_the_earlier(pair: tuple[bytes, bytes]) -> None:
    before, after = pair

    assert changed(before, changes(before, after)) == after


def test_what_is_the_same_takes_no_bytes() -> None:
    assert changes(b"same", b"same") == b""


def test_distant_changes_are_runs_of_their_own() -> None:
    before = bytes(1000)
    after = b"\1" + bytes(998) + b"\1"

    assert len(changes(before, after)) == 2 * (8 + 1)


@pytest.mark.parametrize("runs", [b"\1", b"\0\0\0\0\2\0\0\0\1", b"\xff\xff\0\0\1\0\0\0\1"])
def test_changes_of_something_else_are_refused(runs: bytes) -> None:
    with pytest.raises(RecordingError, match="not complete"):
        changed(b"ab", runs)
