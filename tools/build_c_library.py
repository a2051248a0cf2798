"""Builds the C library that programs in C, Structured Text and Python share.

``python tools/build_c_library.py`` writes ``plcsim/ansi_c/libc/libc.wasm``; it needs a compiler
(``pip install -e '.[c]'``). A test says when that was forgotten after a change of the sources.
"""

from __future__ import annotations

import sys

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.c_library import BINARY, MUSL, OPTIONS, STAMP, sources, stamp
from plcsim.ansi_c.headers import INCLUDE
from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.machine.cache import CodeCache
from plcsim.machine.encoder import name, uleb


def main() -> int:
    """Build it."""
    toolchain = find_toolchain()
    built = build(
        BuildOrder("C library", sources(), [MUSL, INCLUDE], OPTIONS), toolchain, CodeCache(None)
    )
    for warning in built.warnings:
        print(warning)
    content = name(STAMP) + stamp()
    BINARY.write_bytes(built.wasm + b"\0" + uleb(len(content)) + content)
    print(f"{BINARY}: {BINARY.stat().st_size} bytes, by {toolchain.name}")
    return bool(built.warnings)


if __name__ == "__main__":
    sys.exit(main())
