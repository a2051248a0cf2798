"""Structured Text: parser, checker and compiler to WebAssembly."""
