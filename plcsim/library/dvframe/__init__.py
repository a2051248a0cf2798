"""Library dvframe: serial interfaces, of which a simulated controller has none."""

from plcsim.library.dvframe.interface import *  # noqa: F403  # its types and constants
