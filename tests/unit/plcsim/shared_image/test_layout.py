import itertools

from hypothesis import given
from hypothesis import strategies as st

from plcsim.shared_image import layout

sizes = st.lists(st.integers(0, 4000).map(lambda n: 64 * n), max_size=layout.MAX_RINGS)


@given(st.integers(0, 100_000), st.integers(0, 70_000), sizes)
def test_nothing_overlaps(directory: int, bank: int, streams: list[int]) -> None:
    found = layout.regions(directory, bank, streams)
    ends = [(layout.HEADER_SIZE, layout.HEADER_SIZE + directory)]
    ends += [(at, at + bank) for at in found.banks]
    ends += [(found.forces, found.forces + layout.FORCES_SIZE)]
    ends += [(found.events, found.events + layout.EVENTS_SIZE)]
    ends += [(at, at + layout.RING_SIZE) for at in found.rings]
    ends += [(at, at + size) for at, size in zip(found.streams, streams, strict=True)]
    for (_, end), (start, _) in itertools.pairwise(ends):
        assert end <= start
        assert start % 64 == 0
    assert ends[-1][1] <= found.size
    assert len(found.rings) == len(streams)


def test_every_cell_has_a_place_of_its_own_in_the_header() -> None:
    cells = [*range(3), layout.CELL_LATEST, *layout.CELL_BEGIN, *layout.CELL_END]
    cells += [*layout.EVENT_CELLS, *layout.FORCE_CELLS]
    for number in range(layout.MAX_RINGS):
        cells += [*layout.ring_cells(number), *layout.stream_cells(number)]
    assert len(set(cells)) == len(cells)
    assert max(cells) < layout.HEADER_SIZE // 8


def test_the_heads_of_all_rings_lie_side_by_side() -> None:
    heads = [layout.ring_cells(number).head for number in range(layout.MAX_RINGS)]
    assert heads == list(range(layout.HEADS, layout.HEADS + layout.MAX_RINGS))


def test_the_two_ends_of_a_ring_write_to_different_cache_lines() -> None:
    head, tail, refused, samples = layout.ring_cells(3)
    assert head // 8 != tail // 8 == refused // 8 == samples // 8
