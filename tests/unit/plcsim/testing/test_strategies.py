"""Strategies give what tags can take, from their declared types."""

import pytest
from hypothesis import find, given, settings
from hypothesis import strategies as st
from hypothesis.errors import NoSuchExample

from plcsim import Program
from plcsim.core.errors import TagError
from plcsim.testing import open_plc, stimuli, tag_values
from plcsim.testing.strategies import values_of
from st_types import ARRAY, BOOL, INT, LREAL, REAL, STRING, WSTRING, Struct, var
from st_types.types.values import decode, encode


class Inner(Struct):
    flag = var(BOOL)
    text = var(WSTRING(4))


class Everything(Program):
    small = var(INT)
    real = var(REAL)
    long = var(LREAL)
    name = var(STRING(4))
    inner = var(Inner)
    many = var(ARRAY(INT, (0, 2)))


@pytest.fixture(scope="module")
def plc():
    with open_plc(program=Everything) as plc:
        yield plc


@pytest.mark.parametrize("path", ["small", "real", "long", "name", "inner", "many"])
@given(data=st.data())
@settings(max_examples=50)
def test_every_value_fits_and_comes_back(plc, path, data):
    data_type = plc.tags.find(f"Everything.{path}").data_type
    value = data.draw(values_of(data_type))
    assert decode(data_type, encode(data_type, value)) == value


@given(data=st.data())
@settings(max_examples=50)
def test_bounds_hold(plc, data):
    assert 3 <= data.draw(tag_values(plc, "Everything.small", 3, 9)) <= 9
    assert data.draw(tag_values(plc, "Everything.small", low=30_000)) >= 30_000
    assert 0 <= data.draw(tag_values(plc, "Everything.real", 0, 0.5)) <= 0.5


def test_the_ends_of_the_type_are_reached(plc):
    values = tag_values(plc, "Everything.small")
    assert find(values, lambda v: v == 32_767) == 32_767
    with pytest.raises(NoSuchExample):
        find(values, lambda v: v > 32_767)


def test_an_unknown_tag(plc):
    with pytest.raises(TagError, match=r"did you mean Everything.small"):
        tag_values(plc, "Everything.smal")


@given(data=st.data())
@settings(max_examples=30)
def test_stimuli_are_in_order_and_can_be_played(plc, data):
    chosen = {"Everything.small": st.just(5), "Everything.real": st.just(0.5)}
    for paths in (chosen, list(chosen)):
        drawn = data.draw(stimuli(plc, paths, "100ms", most=5))
        assert [t for t, _ in drawn] == sorted(t for t, _ in drawn)
        assert all(0 <= t <= 100_000_000 for t, _ in drawn)
        plc.stimulate(drawn)
        plc.run("110ms")
