"""Library AsUSB as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside
from st_types import Struct

__all__ = [
    "asusbERR_BUFSIZE",
    "asusbERR_NULLPOINTER",
    "asusbERR_USB_NOTFOUND",
    "asusb_CLASS_CDC",
    "asusb_CLASS_HID",
    "asusb_CLASS_HUB",
    "asusb_CLASS_MASS_STORAGE",
    "asusb_CLASS_PRINTER",
    "asusb_CLASS_VENDOR_SPECIFIC",
    "asusb_DEVICENAMELENGTH",
    "asusb_SUBCLASS_HID_BOOT",
    "asusb_SUBCLASS_PRINTER",
    "asusb_SUBCLASS_SCSI_COMMAND_SET",
    "asusb_SUBCLASS_UFI_COMMAND_SET",
    "asusb_USB_DESCR_CONFIG",
    "asusb_USB_DESCR_DEVICE",
    "asusb_USB_DESCR_ENDPOINT",
    "asusb_USB_DESCR_INTERFACE",
    "asusb_USB_DESCR_STRING",
    "asusb_USB_RT_CLASS",
    "asusb_USB_RT_DEVICE",
    "asusb_USB_RT_ENDPOINT",
    "asusb_USB_RT_INTERFACE",
    "asusb_USB_RT_STANDARD",
    "asusb_USB_RT_VENDOR",
    "asusb_USB_UNICODE_ENGLISH",
    "usbConfigDescr_typ",
    "usbDeviceDescr_typ",
    "usbEndpointDescr_typ",
    "usbInterfaceDescr_typ",
    "usbNode_typ",
    "usbStringDescr_typ",
]

_DECLARED = declared_beside(__name__)

asusb_CLASS_CDC: Final = 2

asusb_CLASS_HID: Final = 3

asusb_CLASS_PRINTER: Final = 7

asusb_CLASS_MASS_STORAGE: Final = 8

asusb_CLASS_HUB: Final = 9

asusb_CLASS_VENDOR_SPECIFIC: Final = 255

asusb_SUBCLASS_PRINTER: Final = 1

asusb_SUBCLASS_HID_BOOT: Final = 1

asusb_SUBCLASS_UFI_COMMAND_SET: Final = 4

asusb_SUBCLASS_SCSI_COMMAND_SET: Final = 6

asusb_DEVICENAMELENGTH: Final = 128

asusb_USB_RT_DEVICE: Final = 0

asusb_USB_RT_INTERFACE: Final = 1

asusb_USB_RT_ENDPOINT: Final = 2

asusb_USB_RT_STANDARD: Final = 0

asusb_USB_RT_CLASS: Final = 32

asusb_USB_RT_VENDOR: Final = 64

asusb_USB_DESCR_DEVICE: Final = 1

asusb_USB_DESCR_CONFIG: Final = 2

asusb_USB_DESCR_STRING: Final = 3

asusb_USB_DESCR_INTERFACE: Final = 4

asusb_USB_DESCR_ENDPOINT: Final = 5

asusb_USB_UNICODE_ENGLISH: Final = 1033

asusbERR_USB_NOTFOUND: Final = 32900

asusbERR_BUFSIZE: Final = 32901

asusbERR_NULLPOINTER: Final = 32902


class usbNode_typ(Struct):
    """UsbNode_typ."""

    _plc_type = _DECLARED["usbNode_typ"]

    interfaceClass: int

    interfaceSubClass: int

    interfaceProtocol: int

    vendorId: int

    productId: int

    bcdDevice: int

    ifName: str


class usbDeviceDescr_typ(Struct):
    """UsbDeviceDescr_typ."""

    _plc_type = _DECLARED["usbDeviceDescr_typ"]

    length: int

    descriptorType: int

    bcdUsb: int

    deviceClass: int

    deviceSubClass: int

    deviceProtocol: int

    maxPacketSize0: int

    vendor: int

    product: int

    bcdDevice: int

    manufacturerIndex: int

    productIndex: int

    serialNumberIndex: int

    numConfigurations: int


class usbConfigDescr_typ(Struct):
    """UsbConfigDescr_typ."""

    _plc_type = _DECLARED["usbConfigDescr_typ"]

    bLength: int

    bDescriptorType: int

    wTotalLength: int

    bNumInterfaces: int

    bConfigurationValue: int

    iConfiguration: int

    bmAttributes: int

    MaxPower: int


class usbStringDescr_typ(Struct):
    """UsbStringDescr_typ."""

    _plc_type = _DECLARED["usbStringDescr_typ"]

    length: int

    descriptorType: int

    string: str


class usbInterfaceDescr_typ(Struct):
    """UsbInterfaceDescr_typ."""

    _plc_type = _DECLARED["usbInterfaceDescr_typ"]

    bLength: int

    bDescriptorType: int

    bInterfaceNumber: int

    bAlternateSetting: int

    bNumEndpoints: int

    bInterfaceClass: int

    bInterfaceSubClass: int

    bInterfaceProtocol: int

    iInterface: int


class usbEndpointDescr_typ(Struct):
    """UsbEndpointDescr_typ."""

    _plc_type = _DECLARED["usbEndpointDescr_typ"]

    bLength: int

    bDescriptorType: int

    bEndpointAddress: int

    bmAttributes: int

    wMaxPacketSize: int

    bInterval: int


class UsbNodeListGet(FunctionBlock):
    """Lists devices; asynchronous."""

    _plc_type = _DECLARED["UsbNodeListGet"]

    enable: bool
    """Run the block; FALSE resets it."""

    pBuffer: int
    """Address for the data."""

    bufferSize: int
    """Bytes there."""

    filterInterfaceClass: int

    filterInterfaceSubClass: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    allNodes: int
    """Devices."""

    listNodes: int
    """Devices in the list."""

    attachDetachCount: int
    """Changes."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UsbNodeGet(FunctionBlock):
    """Data of a device; asynchronous."""

    _plc_type = _DECLARED["UsbNodeGet"]

    enable: bool
    """Run the block; FALSE resets it."""

    nodeId: int

    pBuffer: int
    """Address for the data."""

    bufferSize: int
    """Bytes there."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UsbDescriptorGet(FunctionBlock):
    """Descriptor of a device; asynchronous."""

    _plc_type = _DECLARED["UsbDescriptorGet"]

    enable: bool
    """Run the block; FALSE resets it."""

    nodeId: int

    requestType: int

    descriptorType: int

    descriptorIndex: int

    languageId: int

    pBuffer: int
    """Address for the data."""

    bufferSize: int
    """Bytes there."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    actSize: int

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UsbMsDeviceReady(FunctionBlock):
    """Whether a mass storage is ready; asynchronous."""

    _plc_type = _DECLARED["UsbMsDeviceReady"]

    enable: bool
    """Run the block; FALSE resets it."""

    pIfName: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ready: bool

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""
