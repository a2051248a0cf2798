"""Code generation: the intermediate representation becomes WebAssembly with a table of lines."""
