from operator import attrgetter

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from plcsim.library.standard import TOF, TON, TP, TOF_10ms, TON_10ms, TP_10ms
from st_types import TIME

from .diagrams import new_block, play, tidy

MS = 1_000_000
DAY = 24 * 3600 * 1000 * MS

outputs = attrgetter("Q", "ET")

TON_DIAGRAMS = {
    "IN shorter than PT": """
        PT  33333333
        IN  _###____
        Q   ________
        ET  00120000
    """,
    "ET stays at PT while IN is TRUE": """
        PT  3333333333
        IN  __######__
        Q   _____###__
        ET  0001233300
    """,
    "IN is TRUE in the first cycle": """
        PT  22222
        IN  #####
        Q   __###
        ET  01222
    """,
    "IN falls for one cycle": """
        PT  2222222222
        IN  ####_####_
        Q   __##___##_
        ET  0122001220
    """,
    "PT of 0 follows IN": """
        PT  000000
        IN  _##_#_
        Q   _##_#_
        ET  000000
    """,
    "PT raised while running": """
        PT  222555555
        IN  _########
        Q   ______###
        ET  001234555
    """,
    "PT lowered below the time passed": """
        PT  9999222
        IN  _######
        Q   ____###
        ET  0012222
    """,
    "PT set to 0 while running": """
        PT  9999099
        IN  _######
        Q   ____###
        ET  0012000
    """,
    "PT changed after the timer has run out": """
        PT  222291022
        IN  _######_#
        Q   ___####__
        ET  001222200
    """,
}

TOF_DIAGRAMS = {
    "IN is FALSE from the first cycle": """
        PT  333
        IN  ___
        Q   ___
        ET  000
    """,
    "Q falls PT after IN, ET stays at PT": """
        PT  3333333333
        IN  _##_______
        Q   _#####____
        ET  0000123333
    """,
    "IN is TRUE in the first cycle": """
        PT  22222
        IN  #____
        Q   ###__
        ET  00122
    """,
    "IN rises again before PT: the delay starts anew": """
        PT  333333333
        IN  #__#_____
        Q   #######__
        ET  001001233
    """,
    "ET is reset by IN": """
        PT  11111111
        IN  #____##_
        Q   ##___###
        ET  00111000
    """,
    "PT of 0 follows IN": """
        PT  00000
        IN  _##__
        Q   _##__
        ET  00000
    """,
    "PT raised while running": """
        PT  22444444
        IN  #_______
        Q   #####___
        ET  00123444
    """,
    "PT lowered below the time passed": """
        PT  99991111
        IN  #_______
        Q   ####____
        ET  00121111
    """,
    "PT changed after the timer has run out": """
        PT  22229022
        IN  #______#
        Q   ###____#
        ET  00122220
    """,
}

TP_DIAGRAMS = {
    "IN longer than PT: ET stays at PT until IN falls": """
        PT  3333333333
        IN  _######___
        Q   _###______
        ET  0012333000
    """,
    "IN shorter than PT: ET falls with Q": """
        PT  3333333
        IN  _#_____
        Q   _###___
        ET  0012000
    """,
    "IN is TRUE in the first cycle": """
        PT  22222
        IN  #####
        Q   ##___
        ET  01222
    """,
    "IN rises again during the pulse: not retriggered": """
        PT  444444444
        IN  _#_#_____
        Q   _####____
        ET  001230000
    """,
    "IN rises in the cycle in which the pulse ends: no new pulse": """
        PT  333333333
        IN  #__####_#
        Q   ###_____#
        ET  012333300
    """,
    "one FALSE cycle after the pulse is enough for the next": """
        PT  22222222
        IN  ####_###
        Q   ##___##_
        ET  01220012
    """,
    "PT of 0 gives no pulse": """
        PT  000000
        IN  _##_#_
        Q   ______
        ET  000000
    """,
    "PT set to 0 ends the pulse, and setting it back does not start another": """
        PT  555055555
        IN  #######_#
        Q   ###_____#
        ET  012000000
    """,
    "PT raised while running": """
        PT  2244444
        IN  #######
        Q   ####___
        ET  0123444
    """,
    "PT changed after the pulse": """
        PT  222911
        IN  ######
        Q   ##____
        ET  012222
    """,
}


def cases(diagrams):
    return [pytest.param(text, id=name) for name, text in diagrams.items()]


@pytest.mark.parametrize("text", cases(TON_DIAGRAMS))
def test_ton_diagram(text):
    assert play(TON, text) == tidy(text)


@pytest.mark.parametrize("text", cases(TOF_DIAGRAMS))
def test_tof_diagram(text):
    assert play(TOF, text) == tidy(text)


@pytest.mark.parametrize("text", cases(TP_DIAGRAMS))
def test_tp_diagram(text):
    assert play(TP, text) == tidy(text)


def test_negative_pt_runs_out_at_once_with_et_0():
    ton, tof, tp = new_block(TON), new_block(TOF), new_block(TP)
    ton(IN=True, PT=-5)
    assert outputs(ton) == (True, 0)
    tof(IN=True, PT=-5)
    tof(IN=False)
    assert outputs(tof) == (False, 0)
    tp(IN=True, PT=-5)
    assert outputs(tp) == (False, 0)


def test_a_timer_never_runs_out_early_off_the_millisecond_grid():
    ton = new_block(TON, release_ns=900_001)
    ton(IN=True, PT=1)
    ton.context.release_ns = 1_900_000
    ton()
    assert outputs(ton) == (False, 0)
    ton.context.release_ns = 1_900_001
    ton()
    assert outputs(ton) == (True, 1)


def test_cycles_of_a_third_of_a_millisecond_do_not_drift():
    tp = new_block(TP)
    tp(IN=True, PT=20_000)
    for _ in range(59_999):
        tp.context.release_ns += 333_333
        tp()
    assert outputs(tp) == (True, 59_999 * 333_333 // MS)


@pytest.mark.parametrize("release_ns", [0, 2**31 * MS - 1, 2**32 * MS - 1, 2**63 - 200 * DAY])
def test_on_delay_of_the_longest_pt_over_the_wraps_of_the_millisecond(release_ns):
    ton = new_block(TON, release_ns)
    ton(IN=True, PT=TIME.maximum)
    ton.context.release_ns = release_ns + TIME.maximum * MS - 1
    ton()
    assert outputs(ton) == (False, TIME.maximum - 1)
    for days in (25, 49, 50, 51, 99, 100, 199):
        ton.context.release_ns = release_ns + days * DAY
        ton()
        assert outputs(ton) == (True, TIME.maximum)


def test_a_timer_that_is_not_called_for_weeks_has_run_out():
    tof = new_block(TOF)
    tof(IN=True, PT=1000)
    tof(IN=False)
    tof.context.release_ns += 50 * DAY  # 2^32 ms are 49.7 days
    tof()
    assert outputs(tof) == (False, 1000)


def test_timers_of_one_release_agree_however_often_they_are_called():
    ton = new_block(TON)
    other = ton.context.memory.new(TON, ton.context)
    for elapsed in (0, 1, 2, 3, 3):
        ton(IN=True, PT=3)
        ton()
        other(IN=True, PT=3)
        assert bytes(ton) == bytes(other)
        assert outputs(ton) == (elapsed == 3, elapsed)
        ton.context.release_ns += MS


def test_start_lies_in_the_two_internals_as_one_number():
    ton = new_block(TON, release_ns=0x1234_5678_9ABC_DEF0)
    ton(IN=True, PT=1)
    memory = ton.context.memory
    start = memory.read(ton._plc_address + 8, 8)
    assert int.from_bytes(start, "little") == 0x1234_5678_9ABC_DEF1


# Second model: the outputs of a call as a function of all samples so far. A sample is
# (release in ns, IN, PT in ms).


def run_out(samples, start):
    """Return the index at which a timer started at ``start`` runs out, or the length."""
    begin = samples[start][0]
    ends = (i for i in range(start, len(samples)) if samples[i][0] - begin >= samples[i][2] * MS)
    return next(ends, len(samples))


def last_change(samples):
    """Return the first index of the run of equal IN that the last sample belongs to."""
    index = len(samples) - 1
    while index and samples[index - 1][1] == samples[-1][1]:
        index -= 1
    return index


def delay(samples, start):
    """Return whether the delay from ``start`` is over at the last sample, and ET."""
    end = run_out(samples, start)
    if end < len(samples):
        return True, max(0, samples[end][2])
    return False, (samples[-1][0] - samples[start][0]) // MS


def ton_model(samples):
    return delay(samples, last_change(samples)) if samples[-1][1] else (False, 0)


def tof_model(samples):
    start = last_change(samples)
    if samples[-1][1] or start == 0:
        return samples[-1][1], 0
    over, elapsed = delay(samples, start)
    return not over, elapsed


def tp_model(samples):
    last = len(samples) - 1
    ready = 0
    while ready <= last:
        start = next((i for i in range(ready, last + 1) if samples[i][1]), last + 1)
        if start > last:
            break
        end = run_out(samples, start)
        if end > last:
            return True, (samples[last][0] - samples[start][0]) // MS
        ready = next((i for i in range(end, last + 1) if not samples[i][1]), last + 1)
        if ready > last:
            return False, max(0, samples[end][2])
    return False, 0


STEPS = st.one_of(
    st.sampled_from([0, 1, MS // 2, MS - 1, MS, MS + 1, 10 * MS]),
    st.integers(0, 4 * MS),
    st.integers(0, 60 * DAY),
)
PRESETS = st.one_of(st.integers(-2, 6), st.sampled_from([TIME.minimum, TIME.maximum]))


@st.composite
def waveforms(draw):
    """Samples with cycles of any length and a PT that mostly stays, now and then changes."""
    now = draw(st.sampled_from([0, 1, 2**31 * MS - 1, 2**32 - 1, 2**62]))
    preset = draw(PRESETS)
    samples = []
    for step, level, change in draw(
        st.lists(st.tuples(STEPS, st.booleans(), st.none() | PRESETS), min_size=1, max_size=25)
    ):
        preset = preset if change is None else change
        samples.append((now, level, preset))
        now += step
    return samples


@pytest.mark.parametrize(
    ("block_class", "model"), [(TON, ton_model), (TOF, tof_model), (TP, tp_model)]
)
@given(samples=waveforms())
@example(samples=[(0, True, 5), (MS, True, 0), (2 * MS, True, 5)])
def test_block_agrees_with_the_model_in_every_cycle(block_class, model, samples):
    block = new_block(block_class)
    for index, (release_ns, level, preset) in enumerate(samples):
        block.context.release_ns = release_ns
        block(IN=level, PT=preset)
        assert outputs(block) == model(samples[: index + 1]), index


TICK = 10 * MS


@pytest.mark.parametrize(("ticks", "millis"), [(TON_10ms, TON), (TOF_10ms, TOF), (TP_10ms, TP)])
@given(
    pt=st.integers(0, 5),
    levels=st.lists(st.booleans(), max_size=40),
    start=st.integers(0, 2**33),
)
def test_timers_in_ticks_do_what_those_in_milliseconds_do(ticks, millis, pt, levels, start):
    coarse, fine = new_block(ticks), new_block(millis)
    for number, level in enumerate(levels, start):
        coarse.context.release_ns = number * TICK
        coarse(IN=level, PT=pt)
        fine.context.release_ns = number * MS
        fine(IN=level, PT=pt)
        assert outputs(coarse) == outputs(fine)


def test_a_tick_is_10_ms():
    block = new_block(TON_10ms)
    found = []
    for _ in range(8):
        block(IN=True, PT=3)
        found.append((block.ET, block.Q))
        block.context.release_ns += 5 * MS
    assert found == [(0, 0), (0, 0), (1, 0), (1, 0), (2, 0), (2, 0), (3, 1), (3, 1)]
