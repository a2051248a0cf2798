"""The service, the caller in the same controller, and one on another computer."""

import pytest

from crosnode.testing import Ros
from plcsim.testing import ExpectationFailed, Plc

SERVICE = "/add_two_ints"
TYPE = "roscpp_tutorials/TwoInts"


def test_the_caller_gets_right_sums_without_any_ros(plc: Plc) -> None:
    plc.run("2s")
    assert 15 <= plc["caller.right"] <= 20
    assert plc["caller.failed"] == 0
    assert plc["caller.last"] == 2 * plc["caller.right"]


def test_another_computer_can_call(ros: Ros) -> None:
    assert ros.call(SERVICE, TYPE, a=3, b=4).sum == 7
    assert ros.call(SERVICE, TYPE, a=-(2**63), b=2**63 - 1).sum == -1


def test_a_sum_beyond_64_bits_is_refused(ros: Ros) -> None:
    with pytest.raises(ExpectationFailed, match="9223372036854775808 does not fit into 64 bits"):
        ros.call(SERVICE, TYPE, a=2**63 - 1, b=1)


def test_after_exit_nothing_is_registered_any_more(plc: Plc, ros: Ros) -> None:
    plc.until(lambda: SERVICE in ros.system_state().services)
    plc.stop()
    assert SERVICE not in ros.system_state().services
