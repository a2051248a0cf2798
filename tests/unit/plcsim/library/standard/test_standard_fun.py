"""standard.fun is the source of the interfaces: the classes must not drift from it."""

from importlib.resources import files

import pytest

from plcsim.library import standard
from st_types.syntax.declarations import parse_text
from st_types.types.derived import Section
from st_types.types.views import type_of

SECTIONS = {
    "VAR_INPUT": Section.INPUT,
    "VAR_OUTPUT": Section.OUTPUT,
    "VAR": Section.INTERNAL,
}


def declared_blocks():
    """Return (name, type, section) of each member by name of the block, in order."""
    text = files(standard).joinpath("standard.fun").read_text(encoding="utf-8")
    return {
        block.name: [
            (member.name, member.specification.name, SECTIONS[variables.section])
            for variables in block.blocks
            for member in variables.declarations
        ]
        for block in parse_text(text, "standard.fun").items
    }


# Of the struct that Automation Studio generates: analog inputs, outputs, internals, then BOOL.
TIMER = {"PT": 0, "ET": 4, "StartTime": 8, "Restart": 12, "IN": 16, "Q": 17}
LAYOUT = {
    "TON": (20, TIMER | {"M": 18}),
    "TOF": (20, TIMER | {"M": 18}),
    "TP": (20, TIMER),
    "CTU": (8, {"PV": 0, "CV": 2, "CU": 4, "RESET": 5, "Q": 6, "M": 7}),
    "CTD": (8, {"PV": 0, "CV": 2, "CD": 4, "LOAD": 5, "Q": 6, "M": 7}),
    "CTUD": (
        12,
        {"PV": 0, "CV": 2, "CU": 4, "CD": 5, "RESET": 6, "LOAD": 7}
        | {"QU": 8, "QD": 9, "MU": 10, "MD": 11},
    ),
    "R_TRIG": (3, {"CLK": 0, "Q": 1, "M": 2}),
    "F_TRIG": (3, {"CLK": 0, "Q": 1, "M": 2}),
    "SR": (3, {"SET1": 0, "RESET": 1, "Q1": 2}),
    "RS": (3, {"SET": 0, "RESET1": 1, "Q1": 2}),
}


def test_every_declared_block_is_exported():
    assert sorted(declared_blocks()) == sorted(standard.__all__) == sorted(LAYOUT)


@pytest.mark.parametrize("name", standard.__all__)
def test_members_are_as_declared(name):
    members = type_of(getattr(standard, name)).members
    assert [(m.name, m.data_type.name, m.section) for m in members] == declared_blocks()[name]


@pytest.mark.parametrize("name", standard.__all__)
def test_layout_is_that_of_the_generated_c_struct(name):
    data_type = type_of(getattr(standard, name))
    offsets = {m.name: at for m, at in zip(data_type.members, data_type.offsets, strict=True)}
    assert (data_type.size, offsets) == LAYOUT[name]
