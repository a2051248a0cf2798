from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.suggestion import did_you_mean

KNOWN = ["speed", "speed_set", "level"]


def test_the_nearest_name_is_offered() -> None:
    assert did_you_mean("sped", KNOWN) == "; did you mean speed?"
    assert did_you_mean("speed_st", KNOWN, 3) == "; did you mean speed_set, speed?"


def test_case_does_not_matter() -> None:
    assert did_you_mean("q", ["Q", "ET"]) == "; did you mean Q?"
    assert did_you_mean("astcp", ["AsTCP"]) == "; did you mean AsTCP?"


def test_nothing_is_offered_where_nothing_is_near() -> None:
    assert did_you_mean("x", KNOWN) == did_you_mean("speed", []) == ""


@given(st.text(), st.lists(st.text(), max_size=5), st.integers(1, 3))
def test_only_known_names_are_offered(name: str, known: list[str], most: int) -> None:
    hint = did_you_mean(name, iter(known), most)
    near = hint.removeprefix("; did you mean ").removesuffix("?")
    assert not hint or any(near.startswith(other) for other in known)
