"""From the text of Structured Text to its syntax tree."""
