"""Library AsUSB: USB devices, of which a simulated controller has none."""

from plcsim.library.asusb.interface import *  # noqa: F403  # its types and constants
