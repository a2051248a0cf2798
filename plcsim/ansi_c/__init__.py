"""ANSI C for the controller: compiler, headers, C library, and modules on PLC memory.

C is compiled to WebAssembly by clang (`toolchain`, `build`), against headers of our own (`include`)
and those written from declarations (`headers`), and runs on the machine of its controller
(`module`) with the C library that comes along (`libc`).
"""
