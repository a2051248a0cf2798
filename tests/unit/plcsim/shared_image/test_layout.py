import itertools

from hypothesis import given
from hypothesis import strategies as st

from plcsim.shared_image import layout


@given(st.integers(0, 100_000), st.integers(0, 70_000), st.integers(0, layout.MAX_RINGS))
def test_nothing_overlaps(directory: int, bank: int, rings: int) -> None:
    found = layout.regions(directory, bank, rings)
    ends = [(layout.HEADER_SIZE, layout.HEADER_SIZE + directory)]
    ends += [(at, at + bank) for at in found.banks]
    ends += [(at, at + layout.RING_SIZE) for at in found.rings]
    for (_, end), (start, _) in itertools.pairwise(ends):
        assert end <= start
    assert ends[-1][1] <= found.size
    assert len(found.rings) == rings


def test_every_cell_has_a_place_of_its_own_in_the_header() -> None:
    cells = [*range(5), layout.CELL_LATEST, *layout.CELL_BEGIN, *layout.CELL_END]
    for number in range(layout.MAX_RINGS):
        cells += layout.ring_cells(number)
    assert len(set(cells)) == len(cells)
    assert max(cells) < layout.HEADER_SIZE // 8


def test_the_two_ends_of_a_ring_write_to_different_cache_lines() -> None:
    head, tail, refused = layout.ring_cells(3)
    assert head // 8 != tail // 8 == refused // 8
