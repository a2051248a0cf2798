"""What the language is called."""

from typing import Final

NAME: Final = "Structured Text"
