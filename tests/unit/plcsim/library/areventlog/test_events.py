"""Events as numbers. arEVENTLOG_ERR_PARAMETER is one that the controller itself has made."""

import pytest

from plcsim.library.areventlog import arEVENTLOG_ERR_PARAMETER, arEVENTLOG_INF_SIZE


@pytest.mark.parametrize(
    ("severity", "event"),
    [(0, 0x2001_0005), (1, 0x6001_0005), (2, 0xA001_0005 - 2**32), (3, 0xE001_0005 - 2**32)],
)
def test_an_event_of_the_user(plc, severity, event):
    assert plc.function("ArEventLogMakeEventID")(severity, 1, 5) == event
    kinds = ("Success", "Information", "Warning", "Error")
    found = [plc.function(f"ArEventLogIs{kind}")(event) for kind in kinds]
    assert found == [number == severity for number in range(4)]
    assert plc.function("ArEventLogIsCustomerArea")(event) is True


def test_events_of_the_controller(plc):
    assert plc.function("ArEventLogIsError")(arEVENTLOG_ERR_PARAMETER) is True
    assert plc.function("ArEventLogIsCustomerArea")(arEVENTLOG_ERR_PARAMETER) is False
    assert plc.function("ArEventLogIsInformation")(arEVENTLOG_INF_SIZE) is True
