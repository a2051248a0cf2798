"""The tag map: which variable lies at which Modbus address, and how its value is written there.

The offset of the protocol, from 0, is the only address in the map; every other way of counting
(40001, 400001, one-based) is derived from it in exports. docs/modbus.md describes the columns.
"""

from plcsim.modbus.map.errors import AccessRefused, IllegalAddress, IllegalValue, TagMapError
from plcsim.modbus.map.point import Area, MapRow, Point

__all__ = [
    "AccessRefused",
    "Area",
    "IllegalAddress",
    "IllegalValue",
    "MapRow",
    "Point",
    "TagMapError",
]
