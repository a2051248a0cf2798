"""Library AsXml: XML read from memory and written into it.

Texts of a reader are UTF-8. A document type is refused, as it is everywhere here.
"""

from plcsim.library.asxml.interface import *  # noqa: F403  # its constants
