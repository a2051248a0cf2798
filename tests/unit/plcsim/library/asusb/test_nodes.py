"""There are no USB devices."""

import pytest

from plcsim.library.asusb import asusbERR_NULLPOINTER, asusbERR_USB_NOTFOUND, nodes


def test_the_list_is_empty(plc):
    found = plc.finish(nodes.UsbNodeListGet, pBuffer=plc.bytes(bytes(8)), bufferSize=8)
    assert (found.status, found.allNodes, found.listNodes) == (asusbERR_USB_NOTFOUND, 0, 0)


@pytest.mark.parametrize("view", [nodes.UsbNodeListGet, nodes.UsbNodeGet])
def test_null_pointers(plc, view):
    assert plc.finish(view).status == asusbERR_NULLPOINTER


@pytest.mark.parametrize("view", [nodes.UsbNodeGet, nodes.UsbDescriptorGet, nodes.UsbMsDeviceReady])
def test_no_device(plc, view):
    given = {"pBuffer": plc.bytes(bytes(8))} if hasattr(view, "pBuffer") else {}
    assert plc.finish(view, **given).status == asusbERR_USB_NOTFOUND
