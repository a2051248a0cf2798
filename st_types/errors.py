"""Errors of st_types.

::

    TypeSystemError                  base of all
    ├── DeclarationError             a declaration that cannot be: name, bound, initial value
    └── ValueRangeError              a value that its type cannot hold (also a ValueError)
"""


class TypeSystemError(Exception):
    """Base of all errors of this package."""


class DeclarationError(TypeSystemError):
    """A declaration of a type or a variable is wrong."""


class ValueRangeError(TypeSystemError, ValueError):
    """A value does not fit its declared type."""
