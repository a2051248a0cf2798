"""Blocks that look for USB devices, and find none."""

from __future__ import annotations

from plcsim.library.asusb import interface
from plcsim.library.asusb.interface import asusbERR_NULLPOINTER, asusbERR_USB_NOTFOUND
from plcsim.library.block import AsynchronousBlock


class UsbNodeListGet(interface.UsbNodeListGet, AsynchronousBlock):
    """The list of devices, which is empty.

    Outputs: allNodes, listNodes, attachDetachCount (all 0), status (asusbERR_USB_NOTFOUND, or
    asusbERR_NULLPOINTER).
    """

    def step(self) -> int:
        """Look for them."""
        self.allNodes = self.listNodes = self.attachDetachCount = 0
        return asusbERR_USB_NOTFOUND if self.pBuffer else asusbERR_NULLPOINTER


class UsbNodeGet(interface.UsbNodeGet, AsynchronousBlock):
    """Data of a device: there is none. Status asusbERR_USB_NOTFOUND, asusbERR_NULLPOINTER."""

    def step(self) -> int:
        """Look for it."""
        return asusbERR_USB_NOTFOUND if self.pBuffer else asusbERR_NULLPOINTER


class UsbDescriptorGet(interface.UsbDescriptorGet, AsynchronousBlock):
    """Descriptor of a device: there is none. Status asusbERR_USB_NOTFOUND."""

    def step(self) -> int:
        """Look for it."""
        return asusbERR_USB_NOTFOUND


class UsbMsDeviceReady(interface.UsbMsDeviceReady, AsynchronousBlock):
    """Whether a mass storage is ready: there is none. Status asusbERR_USB_NOTFOUND."""

    def step(self) -> int:
        """Look for it."""
        return asusbERR_USB_NOTFOUND
