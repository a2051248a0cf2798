from hypothesis import given
from hypothesis import strategies as st

from plcsim.recorder.journal.record import JournalStore, entries

U32 = st.integers(0, (1 << 32) - 1)


@given(st.lists(st.builds(JournalStore, U32, U32, st.binary(max_size=20)), max_size=5))
def test_entries_are_read_one_after_another(written: list[JournalStore]) -> None:
    assert list(entries(b"".join(each.to_bytes() for each in written))) == written
