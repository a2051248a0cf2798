import pytest

from .units import Rig


@pytest.fixture
def rig():
    return Rig()


@pytest.fixture(params=[False, True], ids=["guarded", "compared"])
def any_rig(request):
    """Both ways in which addresses are checked."""
    return Rig(compare=request.param)
