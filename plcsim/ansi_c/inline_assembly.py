"""Assembler in C that is known: reading the counter of the processor's clock.

WebAssembly has no assembler of another processor. What programs for the controller use it for is
the instruction rdtsc; what they read instead is the controller's clock in nanoseconds, a counter of
1 GHz that stands still within a cycle, so that a run can be repeated.
"""

from __future__ import annotations

import re

_RDTSC = re.compile(
    rb'\b(?:__asm__|__asm|asm)\s*(?:__volatile__|__volatile|volatile)?\s*\(\s*"\s*rdtsc\s*'
    rb'(?:\\[nt]\s*)*"\s*:([^;]*?)\)\s*;'
)
_OUTPUT = re.compile(rb'"=(\w)"\s*\(([^()]*)\)')
_READ = b"*(volatile const unsigned long long *)0x100008"  # RELEASE of plcsim/core/system_area.py
_PARTS = {
    b"a": b"%s = (unsigned)plc_ticks;",
    b"d": b"%s = (unsigned)(plc_ticks >> 32);",
    b"A": b"%s = plc_ticks;",
}


def without_rdtsc(text: bytes) -> bytes:
    """Return a source with the same lines, in which rdtsc reads the clock of the controller."""
    return _RDTSC.sub(_replaced, text)


def _replaced(found: re.Match[bytes]) -> bytes:
    parts = [_PARTS[kind] % name for kind, name in _OUTPUT.findall(found[1]) if kind in _PARTS]
    lines = b"\n" * found[0].count(b"\n")
    return b"{ unsigned long long plc_ticks = %s; %s }%s" % (_READ, b" ".join(parts), lines)
