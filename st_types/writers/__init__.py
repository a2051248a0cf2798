"""Data types as C headers and as Python."""
