import pytest

from .compiled import Compiled


@pytest.fixture
def compiled():
    """``compiled(module, ...)``: a module on a machine."""
    made = []

    def make(*given, **more):
        made.append(Compiled(*given, **more))
        return made[-1]

    yield make
    for one in made:
        one.close()
