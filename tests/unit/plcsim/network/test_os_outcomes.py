import errno

import pytest

from plcsim.network import Outcome
from plcsim.network.os_outcomes import outcome_of


@pytest.mark.parametrize(
    ("number", "outcome"),
    [
        (errno.EAGAIN, Outcome.WOULD_BLOCK),
        (errno.ECONNREFUSED, Outcome.REFUSED),
        (errno.EMSGSIZE, Outcome.INVALID),
        (errno.EIO, Outcome.SYSTEM),
        (None, Outcome.SYSTEM),
    ],
)
def test_errors_of_the_host_have_a_meaning(number, outcome):
    assert outcome_of(OSError(number, "x")) is outcome
