"""IEC 61131-3 data types: declarations, layout, values, typed views. No behaviour."""
