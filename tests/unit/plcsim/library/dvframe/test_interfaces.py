"""There are no serial interfaces."""

import pytest

from plcsim.library.dvframe import frmERR_DEVICEDESCRIPTION, frmERR_NOTOPENED, interfaces
from plcsim.library.installed import installed
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE

BLOCKS = [block.name for block in installed()["plcsim.library.dvframe"].scope.function_blocks]


@pytest.mark.parametrize("name", BLOCKS)
def test_nothing_is_open(plc, name):
    view = getattr(interfaces, name)
    wanted = frmERR_DEVICEDESCRIPTION if name == "FRM_xopen" else frmERR_NOTOPENED
    assert plc.call(view).status == wanted
    idle = plc.new(view)
    idle(enable=False)
    assert idle.status == ERR_FUB_ENABLE_FALSE
