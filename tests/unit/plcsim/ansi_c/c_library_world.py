"""The C library on a memory of its own, called from tests."""

import ctypes
import ctypes.util
import struct

from plcsim.ansi_c.c_library import CLibrary
from plcsim.core.memory import FIRST, PAGE, Memory
from plcsim.machine import CodeCache, Machine

HOST = ctypes.CDLL(ctypes.util.find_library("c"))
"""The C library of the host, to compare with."""

AREA = FIRST
"""16 KiB for arguments."""


class World:
    """The C library on a memory of 64 pages, 2 of them valid."""

    def __init__(self):
        self.memory = Memory(64 * PAGE)
        self.memory.allocate(2 * PAGE)
        self.machine = Machine(self.memory, cache=CodeCache(None))
        self.library = CLibrary(self.machine)

    def call(self, name, *values, params="II", results="i"):
        return self.library.function(name, params[: len(values)], results)(*values)

    def text(self, address, data):
        self.memory.write(address, data + b"\0")
        return address

    def read_text(self, address):
        return self.memory.string(address, 16_000)

    def arguments(self, address, values):
        """Lay out what follows the format of printf: whole numbers, floats, and (number, 64)."""
        data = b""
        for value in values:
            wide = isinstance(value, (float, tuple))
            data = data.ljust(len(data) + (-len(data) % 8 if wide else 0), b"\0")
            if isinstance(value, float):
                data += struct.pack("<d", value)
            elif wide:
                data += (value[0] % 2**64).to_bytes(8, "little")
            else:
                data += (value % 2**32).to_bytes(4, "little")
        self.memory.write(address, data or b"\0")
        return address

    def formatted(self, text, *values, size=8000):
        """Return what snprintf writes, and what it returns."""
        at = self.arguments(AREA + 0x1800, values)
        target, text = AREA + 0x2000, self.text(AREA + 0x1000, text)
        count = self.call("snprintf", target, size, text, at, params="IIII")
        return self.read_text(target).decode("latin-1"), count
