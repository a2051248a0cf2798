"""WebAssembly, the one format that compiled programs run in, on the PLC's own memory.

The only package that knows wasmtime.
"""
