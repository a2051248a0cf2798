"""Programs written in Python."""
