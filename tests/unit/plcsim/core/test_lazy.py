"""Names that are imported at first use."""

import pytest

import plcsim
import plcsim.testing
from plcsim.core.lazy import lazy_names


@pytest.mark.parametrize("package", [plcsim, plcsim.testing])
def test_every_public_name_is_there(package):
    assert all(getattr(package, name) is not None for name in package.__all__)


def test_a_name_that_is_not_there_says_so():
    load = lazy_names("shop", {"Decimal": "decimal"})
    assert load("Decimal").__name__ == "Decimal"
    with pytest.raises(AttributeError, match="module 'shop' has no attribute 'Float'"):
        load("Float")
