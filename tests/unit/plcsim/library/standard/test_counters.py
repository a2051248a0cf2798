from operator import attrgetter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.library.standard import CTD, CTU, CTUD
from st_types import INT, UINT

from .diagrams import new_block, play, tidy

outputs = attrgetter("CV", "Q")
up_down = attrgetter("CV", "QU", "QD")

DIAGRAMS = {
    "CTU counts rising edges, past PV": (
        CTU,
        """
        CU     _#_##_#_#
        RESET  _________
        PV     222222222
        Q      ___######
        CV     011222334
        """,
    ),
    "CTU counts an input that is TRUE in the first cycle": (
        CTU,
        """
        CU     ##_#
        RESET  ____
        PV     2222
        Q      ___#
        CV     1112
        """,
    ),
    "CTU: RESET wins, an edge under it is lost, CU must fall before it counts again": (
        CTU,
        """
        CU     _#_##_#
        RESET  ___#___
        PV     1111111
        Q      _##___#
        CV     0110001
        """,
    ),
    "CTU: Q follows PV without an edge, a PV of 0 is always reached": (
        CTU,
        """
        CU     _#_#__
        RESET  ______
        PV     012931
        Q      ##___#
        CV     011222
        """,
    ),
    "CTD loads PV and counts to 0, not below": (
        CTD,
        """
        CD     ___#_#_#_#
        LOAD   _#________
        PV     9333333333
        Q      #______###
        CV     0332211000
        """,
    ),
    "CTD: LOAD wins, an edge under it is lost": (
        CTD,
        """
        CD     _###_#
        LOAD   ###___
        PV     523333
        Q      ______
        CV     523332
        """,
    ),
    "CTUD counts both ways, edges of both in one cycle cancel": (
        CTUD,
        """
        CU     _#_#_#_#__
        CD     _____#__#_
        RESET  __________
        LOAD   __________
        PV     2222222222
        QU     ___#######
        QD     #_________
        CV     0112222322
        """,
    ),
    "CTUD: RESET wins over LOAD, LOAD over the edges": (
        CTUD,
        """
        CU     __#_#_#_
        CD     ________
        RESET  __##____
        LOAD   _###____
        PV     77777777
        QU     _#______
        QD     #_##____
        CV     07001122
        """,
    ),
}


@pytest.mark.parametrize(
    ("block_class", "text"), [pytest.param(*case, id=name) for name, case in DIAGRAMS.items()]
)
def test_diagram(block_class, text):
    assert play(block_class, text) == tidy(text)


def pulse(block, name, times):
    for _ in range(times):
        block(**{name: True})
        block(**{name: False})


def test_ctu_stops_at_the_largest_uint():
    counter = new_block(CTU)
    counter(PV=UINT.maximum)
    counter.CV = UINT.maximum - 1
    pulse(counter, "CU", 3)
    assert outputs(counter) == (65535, True)


def test_ctud_stops_at_both_ends_of_int():
    counter = new_block(CTUD)
    counter(LOAD=True, PV=INT.maximum - 1)
    counter.LOAD = False
    pulse(counter, "CU", 3)
    assert up_down(counter) == (32767, True, False)
    counter(LOAD=True, PV=INT.minimum + 1)
    counter.LOAD = False
    pulse(counter, "CD", 3)
    assert up_down(counter) == (-32768, False, True)


def test_ctud_counts_below_zero():
    counter = new_block(CTUD)
    pulse(counter, "CD", 2)
    assert up_down(counter) == (-2, False, True)


# Second model: CV from the list of all calls; an edge is a pair of neighbours, and everything
# before the last RESET or LOAD is forgotten.


def edges(levels):
    return [now and not before for before, now in zip([False, *levels], levels, strict=False)]


def model(calls, low, high):
    """Return CV after ``calls`` of (CU, CD, RESET, LOAD, PV)."""
    up, down = (edges([call[i] for call in calls]) for i in (0, 1))
    sets = [i for i, call in enumerate(calls) if call[2] or call[3]]
    count = 0 if not sets or calls[sets[-1]][2] else calls[sets[-1]][4]
    for i in range(sets[-1] + 1 if sets else 0, len(calls)):
        if up[i] != down[i]:
            count = min(high, count + 1) if up[i] else max(low, count - 1)
    return count


def calls_of(counted, presets):
    flag = st.booleans()
    rare = st.sampled_from([False] * 5 + [True])
    off = st.just(False)
    return st.lists(
        st.tuples(
            flag if "CU" in counted else off,
            flag if "CD" in counted else off,
            rare if "CU" in counted else off,
            rare if "CD" in counted else off,
            st.integers(-3, 3).map(lambda i: presets[i]),
        ),
        max_size=30,
    )


@given(calls_of(("CU",), range(65536)))
def test_ctu_agrees_with_the_model(calls):
    block = new_block(CTU)
    for i, (up, _, reset, _, preset) in enumerate(calls):
        block(CU=up, RESET=reset, PV=preset)
        count = model(calls[: i + 1], 0, 65535)
        assert outputs(block) == (count, count >= preset)


@given(calls_of(("CD",), range(65536)))
def test_ctd_agrees_with_the_model(calls):
    block = new_block(CTD)
    for i, (_, down, _, load, preset) in enumerate(calls):
        block(CD=down, LOAD=load, PV=preset)
        count = model(calls[: i + 1], 0, 65535)
        assert outputs(block) == (count, count <= 0)


@given(calls_of(("CU", "CD"), [0, 1, 2, 32767, -32768, -1, 32766]))
def test_ctud_agrees_with_the_model(calls):
    block = new_block(CTUD)
    for i, (up, down, reset, load, preset) in enumerate(calls):
        block(CU=up, CD=down, RESET=reset, LOAD=load, PV=preset)
        count = model(calls[: i + 1], -32768, 32767)
        assert up_down(block) == (count, count >= preset, count <= 0)
