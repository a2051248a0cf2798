"""Library AsARCfg: addresses, names and the time zone of the controller, as far as programs ask.

What is set is read back and changes nothing else: neither the host's network nor the date. A
restart forgets it.
"""

from plcsim.library.asarcfg.interface import *  # noqa: F403  # its constants
