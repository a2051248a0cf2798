"""What a campaign varies."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.campaign import CampaignError, Choice, Integer, Uniform

SHARES = st.floats(0, 1, exclude_max=True)


@given(SHARES)
def test_every_share_gives_a_value_within_the_limits(share: float) -> None:
    assert -2.5 <= Uniform(-2.5, 7).at(share) <= 7
    assert Integer(-1, 1).at(share) in (-1, 0, 1)
    assert Choice("a", "b", "c").at(share) in ("a", "b", "c")


def test_whole_numbers_are_equally_likely() -> None:
    values = [Integer(1, 4).at(n / 1000) for n in range(1000)]
    assert [values.count(n) for n in (1, 2, 3, 4)] == [250] * 4


def test_a_grid_has_both_ends() -> None:
    assert Uniform(0, 1).steps(3) == [0, 0.5, 1]
    assert Integer(0, 10).steps(3) == [0, 5, 10]
    assert Integer(0, 2).steps(5) == [0, 1, 2]
    assert Uniform(0, 1, nominal=0.25).steps(1) == [0.25]
    assert Choice(1, 2).steps(9) == (1, 2)


@given(st.floats(0, 100))
def test_every_simpler_number_is_simpler(value: float) -> None:
    variable = Uniform(0, 100, nominal=50)
    for simpler in variable.simpler(value):
        assert 0 <= simpler <= 100
        assert simpler != value
        assert value not in variable.simpler(simpler)


@given(st.integers(-20, 30))
def test_simpler_whole_numbers_are_nearer_to_the_nominal_one(value: int) -> None:
    assert all(abs(v - 3) < abs(value - 3) for v in Integer(-20, 30, nominal=3).simpler(value))


def test_choices_named_before_are_simpler() -> None:
    assert Choice("works", "late", "stuck").simpler("stuck") == ("works", "late")
    assert Choice("works", "late").simplest == "works"


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: Uniform(1, 1), "the first is to be the smaller"),
        (lambda: Uniform(0, float("nan")), "the first is to be the smaller"),
        (lambda: Uniform(0, 1, nominal=2), "nominal is to lie between"),
        (lambda: Integer(2, 1), "the first is to be the smaller"),
        (Choice, "name at least one value"),
    ],
)
def test_what_cannot_be_varied_is_refused(make: object, text: str) -> None:
    assert callable(make)
    with pytest.raises(CampaignError, match=text):
        make()
