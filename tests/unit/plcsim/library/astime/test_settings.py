from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.library.astime.settings import AsTimeSettings
from plcsim.settings import Table


def read(**keys):
    return Table(Path("plc.toml"), "library.astime", keys).read(AsTimeSettings)


def test_local_time_is_utc_by_default():
    assert read().utc_offset == 0


def test_the_offset_has_bounds():
    assert read(utc_offset=-840).utc_offset == -840
    with pytest.raises(ConfigurationError, match=r"841 is outside -840\.\.840"):
        read(utc_offset=841)
