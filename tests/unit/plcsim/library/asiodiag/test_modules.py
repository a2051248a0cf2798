"""The controller is simulated, and has no modules."""

import pytest

from plcsim.library import asiodiag
from plcsim.library.asiodiag import (
    asdiagERR_IDENT,
    asdiagERR_INDEX,
    asdiagERR_INFOKIND,
    asdiagPLUGGED,
)
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE, ERR_OK


@pytest.mark.parametrize("name", ["DiagCpuIsSimulated", "DiagCpuIsARsim"])
def test_it_is_simulated(plc, name):
    assert plc.function(name)() is True


def test_the_list_of_modules_is_empty(plc):
    made = plc.call(asiodiag.DiagCreateInfo, infoKind=asdiagPLUGGED)
    assert (made.status, made.nrEntries) == (ERR_OK, 0)
    number = plc.call(asiodiag.DiagGetNumInfo, ident=made.ident, infoCode=1)
    assert number.status == asdiagERR_INDEX
    text = plc.call(asiodiag.DiagGetStrInfo, ident=made.ident, infoCode=1001)
    assert text.status == asdiagERR_INDEX
    assert plc.call(asiodiag.DiagDisposeInfo, ident=made.ident).status == ERR_OK


def test_wrong_kinds_and_idents(plc):
    assert plc.call(asiodiag.DiagCreateInfo, infoKind=9).status == asdiagERR_INFOKIND
    for block in asiodiag.DiagGetNumInfo, asiodiag.DiagGetStrInfo, asiodiag.DiagDisposeInfo:
        assert plc.call(block, ident=77).status == asdiagERR_IDENT


def test_disabled(plc):
    block = plc.new(asiodiag.DiagCreateInfo)
    block()
    assert block.status == ERR_FUB_ENABLE_FALSE
