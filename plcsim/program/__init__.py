"""Programs: their declarations, and the languages they are written in."""
