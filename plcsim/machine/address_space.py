"""PLC memory once more, at a place where compiled code may run into any 32-bit address.

4 GiB of addresses are reserved (nothing but address space), and the pages of the PLC memory are
mapped into them a second time, each at its own PLC address. What is not valid there has no rights,
so the processor itself checks each access of compiled code, and a wild one is a trap.

Where the process may not have that many addresses (RLIMIT_AS), only the memory itself is mapped and
compiled code compares each address with its end; nil and the limit are guarded by the processor
there too.

Source: mmap(2).
"""

from __future__ import annotations

import ctypes
import mmap
import os
import resource
from ctypes import c_int, c_long, c_size_t, c_void_p
from typing import TYPE_CHECKING

from plcsim.core.memory import FIRST
from plcsim.machine.errors import MachineError

if TYPE_CHECKING:
    from plcsim.core.memory import Memory

RESERVATION = 1 << 32
"""Bytes: every address that 32 bits can name."""

GUARD = 64 << 20
"""Bytes behind it, for the offset of an instruction that comes on top of an address."""

_MAP_NORESERVE = 0x4000
_MAP_FIXED = 0x10
_RIGHTS = mmap.PROT_READ | mmap.PROT_WRITE
_FAILED = ctypes.c_void_p(-1).value

_libc = ctypes.CDLL(None, use_errno=True)
_libc.mmap.restype = c_void_p
_libc.mmap.argtypes = [c_void_p, c_size_t, c_int, c_int, c_int, c_long]
_libc.mprotect.argtypes = [c_void_p, c_size_t, c_int]
_libc.munmap.argtypes = [c_void_p, c_size_t]


def must_compare() -> bool:
    """Return whether compiled code must compare addresses, as the address space is limited."""
    return resource.getrlimit(resource.RLIMIT_AS)[0] != resource.RLIM_INFINITY


class AddressSpace:
    """The second mapping of a PLC memory.

    Args:
        memory: the memory; it goes on being allocated from.
        compare: compiled code compares addresses, so nothing beyond the memory is reserved.

    Attributes:
        base: where PLC address 0 lies in this process.
        size: bytes from there that are memory, valid or not.

    Raises:
        MachineError: the host has no room.
    """

    def __init__(self, memory: Memory, *, compare: bool = False) -> None:
        self.size = FIRST + memory.size
        self._length = self.size if compare else RESERVATION + GUARD
        self.base = _reserve(self._length)
        for file in memory.files:
            self._map(*file)
        self._follow(memory)
        memory.follow(self._follow)

    def _map(self, fd: int, address: int, size: int) -> None:
        """Map a file at a PLC address as well."""
        flags = mmap.MAP_SHARED | _MAP_FIXED
        if _libc.mmap(self.base + address, size, _RIGHTS, flags, fd, 0) == _FAILED:
            raise MachineError(f"PLC memory cannot be mapped again: {_reason()}")

    def _follow(self, memory: Memory) -> None:
        """Give rights to what is valid, and to nothing else."""
        if not self.base:
            return
        stack, limit = memory.stack, memory.limit
        self._protect(0, stack, 0)
        self._protect(stack, limit, _RIGHTS)
        self._protect(limit, self.size, 0)

    def _protect(self, start: int, end: int, rights: int) -> None:
        if start < end and _libc.mprotect(self.base + start, end - start, rights):
            raise MachineError(f"PLC memory cannot be guarded: {_reason()}")

    def close(self) -> None:
        """Give the addresses back; no compiled code may run on them any more."""
        if self.base:
            _libc.munmap(self.base, self._length)
            self.base = 0


def _reserve(length: int) -> int:
    flags = mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS | _MAP_NORESERVE
    base: int = _libc.mmap(None, length, 0, flags, -1, 0)
    if base == _FAILED:
        raise MachineError(f"{length >> 20} MiB of addresses for compiled programs: {_reason()}")
    return base


def _reason() -> str:
    return os.strerror(ctypes.get_errno())
