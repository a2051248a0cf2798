from __future__ import annotations

from typing import TYPE_CHECKING

from hypothesis import given
from hypothesis import strategies as st

from plcsim.library.astcp.idents import IdentTable
from plcsim.library.idents import LAST_IDENT

from .plc import Plc, World

if TYPE_CHECKING:
    from plcsim.network import Socket


def a_socket(plc: Plc) -> Socket:
    made = plc.context.network.open("", 0).socket
    assert made is not None
    return made


def test_an_ident_is_never_nil_and_never_given_twice(world: World) -> None:
    plc = world.server
    given = []
    for _ in range(5):
        given.append(plc.idents.give(a_socket(plc)))
        plc.idents.remove(given[-1])
    assert 0 not in given
    assert len(set(given)) == 5


def test_counting_goes_round_and_steps_over_what_is_in_use(world: World) -> None:
    plc = world.server
    first = plc.idents.give(a_socket(plc))
    plc.idents._last = LAST_IDENT - 1
    assert plc.idents.give(a_socket(plc)) == LAST_IDENT
    assert plc.idents.give(a_socket(plc)) == first + 1


def test_removing_closes_the_socket(world: World) -> None:
    plc = world.server
    made = a_socket(plc)
    plc.idents.remove(plc.idents.give(made))
    assert made.local.port == 0


def test_closing_the_table_closes_all(world: World) -> None:
    plc = world.server
    made = [a_socket(plc) for _ in range(3)]
    for each in made:
        plc.idents.give(each)
    plc.context.restart()
    assert [each.local.port for each in made] == [0, 0, 0]
    assert plc.idents.in_use() == ()


@given(st.lists(st.booleans(), max_size=60))
def test_the_table_is_full_exactly_at_its_size(adds: list[bool]) -> None:
    plc = World(idents=4).server
    for add in adds:
        in_use = plc.idents.in_use()
        assert plc.idents.full is (len(in_use) == 4)
        if add and not plc.idents.full:
            plc.idents.give(a_socket(plc))
        elif in_use:
            plc.idents.remove(in_use[0])
    assert isinstance(plc.idents, IdentTable)
