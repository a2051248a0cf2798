"""Data types of IEC 61131-3: layout, values, typed views."""
