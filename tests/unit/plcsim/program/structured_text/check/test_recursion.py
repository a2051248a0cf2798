"""Functions that call themselves."""

import pytest

from plcsim.program.structured_text.check.recursion import reaches

CALLS = {"a": {"b"}, "b": {"c", "LEN"}, "c": {"b"}, "d": {"d"}, "e": {"a"}}


@pytest.mark.parametrize(
    ("name", "expected"),
    [("a", False), ("b", True), ("c", True), ("d", True), ("e", False), ("LEN", False)],
)
def test_a_call_of_itself_by_whatever_others(name, expected):
    assert reaches(name, CALLS) is expected
