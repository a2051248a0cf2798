"""Bodies of the assertions: a test ends by the first that does not hold."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from plcsim.library.executable import function
from plcsim.testing.st_program import TestState
from st_types.types.elementary import ELEMENTARY
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    from plcsim.core.context import Context

LONGEST: Final = 255
_EXACT: Final = (
    *("BOOL", "SINT", "USINT", "INT", "UINT", "DINT", "UDINT", "LINT", "ULINT"),
    *("BYTE", "WORD", "DWORD", "LWORD", "TIME", "DATE_AND_TIME"),
)


def _text(context: Context, address: int) -> str:
    return context.memory.string(address, LONGEST).decode("latin-1")


def _require(context: Context, holds: bool, seen: str, message: int) -> bool:
    if not holds:
        said = _text(context, message)
        raise AssertionError(f"{said}: {seen}" if said else seen)
    return True


@function("AssertTrue")
def assert_true(context: Context, condition: bool, message: int) -> bool:
    """Require TRUE."""
    return _require(context, condition, "expected TRUE, got FALSE", message)


@function("AssertFalse")
def assert_false(context: Context, condition: bool, message: int) -> bool:
    """Require FALSE."""
    return _require(context, not condition, "expected FALSE, got TRUE", message)


@function("AssertEquals_STRING")
def assert_equal_texts(context: Context, expected: int, actual: int, message: int) -> bool:
    """Require two STRINGs with the same characters."""
    one, other = _text(context, expected), _text(context, actual)
    return _require(context, one == other, f"expected {one!r}, got {other!r}", message)


@function("TEST_FINISHED")
def finish(context: Context) -> bool:
    """End the test after this cycle."""
    context.library(TestState).is_finished = True
    return True


def _exact(name: str) -> object:
    data_type = ELEMENTARY[name]

    @function(f"AssertEquals_{name}")
    def assert_equal(context: Context, expected: int, actual: int, message: int) -> bool:
        seen = f"expected {value_text(data_type, expected)}, got {value_text(data_type, actual)}"
        return _require(context, expected == actual, seen, message)

    return assert_equal


def _near(name: str) -> object:
    data_type = ELEMENTARY[name]

    @function(f"AssertEquals_{name}")
    def assert_near(
        context: Context, expected: float, actual: float, delta: float, message: int
    ) -> bool:
        one, other = value_text(data_type, expected), value_text(data_type, actual)
        seen = f"expected {one} within {value_text(data_type, delta)}, got {other}"
        holds = expected == actual or abs(expected - actual) <= delta
        return _require(context, holds and not math.isnan(actual), seen, message)

    return assert_near


# One function a type: the bodies of a library are the names of its module.
globals().update({f"assert_equal_{name.lower()}": _exact(name) for name in _EXACT})
globals().update({f"assert_equal_{name.lower()}": _near(name) for name in ("REAL", "LREAL")})
