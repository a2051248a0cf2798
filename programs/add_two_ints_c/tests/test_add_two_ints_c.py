"""The service in C: asked by another computer, and by itself."""

from crosnode.testing import Ros
from plcsim.testing import Plc

SERVICE = "/add_two_ints"
TYPE = "roscpp_tutorials/TwoInts"


def test_it_calls_itself(plc: Plc) -> None:
    plc.run("2s")
    assert 5 <= plc["provider.answered"] <= 20
    assert plc["provider.last"] == plc["provider.answered"] - 1 + 2


def test_another_computer_can_call(ros: Ros) -> None:
    assert ros.call(SERVICE, TYPE, a=3, b=4).sum == 7
    assert ros.call(SERVICE, TYPE, a=-(2**63), b=2**63 - 1).sum == -1


def test_after_exit_nothing_is_registered_any_more(plc: Plc, ros: Ros) -> None:
    plc.until(lambda: SERVICE in ros.system_state().services)
    plc.stop()
    assert SERVICE not in ros.system_state().services
