"""Layout of the standard blocks is that of the controller; members follow from standard.fun."""

import pytest

from plcsim.library import standard
from plcsim.library.installed import installed
from st_types.types.views import type_of

# Of the struct that Automation Studio generates: analog inputs, outputs, internals, then BOOL.
TIMER = {"PT": 0, "ET": 4, "StartTime": 8, "Restart": 12, "IN": 16, "Q": 17}
TICKS = {"PT": 0, "ET": 4, "StartTime": 8, "IN": 12, "Q": 13}
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
    "TON_10ms": (16, TICKS | {"M": 14}),
    "TOF_10ms": (16, TICKS | {"M": 14}),
    "TP_10ms": (16, TICKS),
    "RF_TRIG": (3, {"CLK": 0, "Q": 1, "M": 2}),
    "SEMA": (4, {"CLAIM": 0, "RELEASE": 1, "BUSY": 2, "X": 3}),
}


@pytest.fixture(scope="module")
def scope():
    return installed()["plcsim.library.standard"].scope


def test_each_block_has_its_layout_here(scope):
    assert sorted(block.name for block in scope.function_blocks) == sorted(LAYOUT)


@pytest.mark.parametrize("name", LAYOUT)
def test_layout_is_that_of_the_generated_c_struct(scope, name):
    data_type = type_of(getattr(standard, name))
    assert data_type is scope.find_type(name)
    offsets = {m.name: at for m, at in zip(data_type.members, data_type.offsets, strict=True)}
    assert (data_type.size, offsets) == LAYOUT[name]
