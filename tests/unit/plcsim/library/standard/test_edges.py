import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.library.standard import F_TRIG, R_TRIG, RF_TRIG

from .diagrams import new_block, play, tidy

DIAGRAMS = {
    "R_TRIG": (R_TRIG, "CLK _##_#__\nQ   _#__#__"),
    "R_TRIG fires in a first cycle with CLK TRUE": (R_TRIG, "CLK ###_#\nQ   #___#"),
    "F_TRIG": (F_TRIG, "CLK _##_#__\nQ   ___#_#_"),
    "F_TRIG does not fire in a first cycle with CLK FALSE": (F_TRIG, "CLK ___#_\nQ   ____#"),
    "RF_TRIG": (RF_TRIG, "CLK _##_#__\nQ   _#_###_"),
    "RF_TRIG fires in a first cycle with CLK TRUE": (RF_TRIG, "CLK ##\nQ   #_"),
    "F_TRIG with CLK TRUE from the first cycle": (F_TRIG, "CLK ##_#_\nQ   __#_#"),
}


@pytest.mark.parametrize(
    ("block_class", "text"), [pytest.param(*case, id=name) for name, case in DIAGRAMS.items()]
)
def test_diagram(block_class, text):
    assert play(block_class, text) == tidy(text)


@given(st.lists(st.booleans()))
def test_one_pulse_for_each_change_of_neighbours(levels):
    rising, falling = new_block(R_TRIG), new_block(F_TRIG)
    for before, now in zip([False, *levels], levels, strict=False):
        rising(CLK=now)
        falling(CLK=now)
        assert rising.Q is (now and not before)
        assert falling.Q is (before and not now)
