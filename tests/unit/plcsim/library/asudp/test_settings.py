from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.library.asudp.settings import AsUdpSettings
from plcsim.settings import Table


def test_idents_have_bounds():
    def read(**keys):
        return Table(Path("plc.toml"), "library.AsUDP", keys).read(AsUdpSettings)

    assert read().idents == 128
    assert read(idents=1).idents == 1
    with pytest.raises(ConfigurationError, match=r"0 is outside 1\.\.65535"):
        read(idents=0)
