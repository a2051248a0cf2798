import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.library.standard import RS, SEMA, SR

from .diagrams import new_block, play, tidy

DIAGRAMS = {
    "SR: set has priority": (
        SR,
        """
        SET1   _#___##_
        RESET  ___#_##_
        Q1     _##__###
        """,
    ),
    "SEMA: claimed, claimed again, given back": (
        SEMA,
        """
        CLAIM   _##__#_#_
        RELEASE ____#_##_
        BUSY    __##____#
        """,
    ),
    "RS: reset has priority": (
        RS,
        """
        SET    _#__##_#_
        RESET1 ___#_##__
        Q1     _##_#__##
        """,
    ),
}


@pytest.mark.parametrize(
    ("block_class", "text"), [pytest.param(*case, id=name) for name, case in DIAGRAMS.items()]
)
def test_diagram(block_class, text):
    assert play(block_class, text) == tidy(text)


@given(st.lists(st.tuples(st.booleans(), st.booleans())))
def test_the_last_call_with_an_input_decides(calls):
    sr, rs = new_block(SR), new_block(RS)
    set_first = reset_first = False
    for set_, reset in calls:
        sr(SET1=set_, RESET=reset)
        rs(SET=set_, RESET1=reset)
        if set_ or reset:
            set_first, reset_first = set_, not reset
        assert sr.Q1 is set_first
        assert rs.Q1 is reset_first
