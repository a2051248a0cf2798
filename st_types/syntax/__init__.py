"""Source text to syntax trees of declarations, and back."""
