"""Library AsETH: IP addresses as numbers. What else it declares asks for the hardware."""

from plcsim.library.aseth.interface import *  # noqa: F403  # its constants
