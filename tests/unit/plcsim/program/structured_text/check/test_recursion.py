"""Functions that call themselves."""

from plcsim.program.structured_text.check.recursion import in_cycles

CALLS = {"a": {"b"}, "b": {"c", "LEN"}, "c": {"b"}, "d": {"d"}, "e": {"a"}, "f": set()}


def test_calls_of_themselves_by_whatever_others():
    assert in_cycles(CALLS) == {"b", "c", "d"}


def test_what_is_called_between_two_of_them_counts_too():
    between = {"a": {"a", "x"}, "x": {"y"}, "y": {"b", "z"}, "z": set(), "b": {"b"}}
    assert in_cycles(between) == {"a", "x", "y", "b"}


def test_a_long_chain_takes_time_in_proportion():
    chain = {str(number): {str(number + 1)} for number in range(100_000)}
    assert in_cycles(chain) == set()
    assert len(in_cycles(chain | {"100000": {"0"}})) == 100_001
