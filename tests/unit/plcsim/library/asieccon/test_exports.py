"""Conversions; values by hand, those of texts have the form of literals."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.library.asieccon.exports import EXPORTS
from plcsim.library.installed import installed

DT = 1_774_936_800
"""2026-03-31 06:00:00, a Tuesday."""


def test_every_conversion_has_a_body():
    declared = {f.name for f in installed()["plcsim.library.asieccon"].scope.functions}
    assert len(declared) == 338
    assert declared == set(EXPORTS) & declared


@pytest.mark.parametrize(
    ("name", "value", "result"),
    [
        ("INT_TO_USINT", 300, 44),
        ("INT_TO_SINT", 200, -56),
        ("DINT_TO_UINT", -1, 65535),
        ("UDINT_TO_DINT", 4294967295, -1),
        ("UDINT_TO_INT", 98304, -32768),
        ("USINT_TO_BOOL", 4, True),
        ("REAL_TO_BOOL", 0.25, True),
        ("BOOL_TO_REAL", True, 1.0),
        ("BOOL_TO_TIME", True, 1),
        ("DINT_TO_REAL", 16777217, 16777216.0),
        ("DINT_TO_LREAL", 16777217, 16777217.0),
        ("REAL_TO_INT", 2.5, 3),
        ("REAL_TO_INT", -2.5, -3),
        ("REAL_TO_USINT", 256.4, 0),
        ("REAL_TO_UDINT", 4e9, 4000000000),
        ("LREAL_TO_DINT", -0.5, -1),
        ("REAL_TO_TIME", 1499.5, 1500),
        ("LREAL_TO_REAL", 0.1, 0.10000000149011612),
        ("TIME_TO_UDINT", -1, 4294967295),
        ("DT_TO_DATE", DT, DT - 6 * 3600),
        ("DT_TO_TOD", DT, 6 * 3600 * 1000),
        ("DWORD_TO_USINT", 0x1234, 0x34),
        ("swapUINT", 0x1234, 0x3412),
        ("swapINT", 0x00FF, -256),
        ("swapDWORD", 0x12345678, 0x78563412),
        ("H_TO_NUDINT", 1, 0x01000000),
        ("N_TO_HDINT", 0xFF, -16777216),
        ("swapREAL", 1.0, 4.6006e-41),
        ("swapLREAL", 1.0, 3.03865e-319),
    ],
)
def test_numbers(plc, name, value, result):
    assert plc.function(name)(value) == pytest.approx(result, rel=1e-4, abs=0)


@pytest.mark.parametrize(
    ("name", "value", "text"),
    [
        ("BOOL", True, "TRUE"),
        ("BOOL", False, "FALSE"),
        ("SINT", -128, "-128"),
        ("DINT", -2147483648, "-2147483648"),
        ("UDINT", 4294967295, "4294967295"),
        ("BYTE", 255, "255"),
        ("REAL", 115.4, "115.4"),
        ("REAL", 2.0, "2"),
        ("LREAL", 0.1, "0.1"),
        ("TIME", 0, "T#0ms"),
        ("TIME", 93_784_005, "T#1d2h3m4s5ms"),
        ("TIME", -1500, "T#-1s500ms"),
        ("TIME", -2147483648, "T#-24d20h31m23s648ms"),
        ("DT", DT, "DT#2026-03-31-06:00:00"),
        ("DATE", DT, "D#2026-03-31"),
        ("TOD", 21_600_000, "TOD#06:00:00"),
        ("TOD", 86_399_999, "TOD#23:59:59.999"),
    ],
)
def test_texts_and_back(plc, name, value, text):
    assert plc.function(f"{name}_TO_STRING")(value) == text
    assert plc.function(f"{name}_TO_WSTRING")(value) == text
    back = DT - 6 * 3600 if name == "DATE" else value
    assert plc.function(f"STRING_TO_{name}")(plc.text(text)) == pytest.approx(back, rel=1e-7)
    wide = plc.bytes(text.encode("utf-16-le") + bytes(2))
    assert plc.function(f"WSTRING_TO_{name}")(wide) == pytest.approx(back, rel=1e-7)


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("INT", "  -12 apples", -12),
        ("UINT", "16#FF", 255),
        ("USINT", "2#101", 5),
        ("USINT", "300", 44),
        ("DINT", "apples", 0),
        ("DINT", "", 0),
        ("BOOL", "true", True),
        ("BOOL", "1", True),
        ("BOOL", "no", False),
        ("TIME", "500", 500),
        ("TIME", "TIME#1h_30m", 5_400_000),
        ("TIME", "t#2.5s", 2500),
        ("TIME", "T#", 0),
        ("TIME", "T#5x", 0),
        ("DT", "2026-03-31-06:00:00", DT),
        ("DT", "2026-03-31 06:00:00", DT),
        ("DT", "DATE_AND_TIME#2026-03-31", DT - 6 * 3600),
        ("DT", "31.3.2026", 0),
        ("TOD", "06:30", 23_400_000),
    ],
)
def test_texts_people_write(plc, name, text, value):
    assert plc.function(f"STRING_TO_{name}")(plc.text(text)) == value


def test_between_string_and_wstring(plc):
    assert plc.function("STRING_TO_WSTRING")(plc.text("käse")) == "käse"
    wide = plc.bytes("käω".encode("utf-16-le") + bytes(2))
    assert plc.function("WSTRING_TO_STRING")(wide) == "kä?"
    assert plc.function("STRING_TO_WSTRING")(plc.text("x" * 100)) == "x" * 80


TEXTS = st.text(st.characters(min_codepoint=1, max_codepoint=255), max_size=60)


@given(TEXTS)
def test_any_text_gives_a_value_of_the_type(text):
    read = _read("STRING_TO_SINT")
    assert -128 <= read(text) <= 127
    assert 0 <= _read("STRING_TO_DT")(text) < 2**32
    assert -(2**31) <= _read("STRING_TO_TIME")(text) < 2**31
    assert 0 <= _read("STRING_TO_TOD")(text) < 2**32


_READERS = {}


def _read(name):
    """Return a conversion from a text, on one controller for all examples."""
    from ..conftest import Plc

    if not _READERS:
        plc = _READERS["plc"] = Plc()
        _READERS["place"] = plc.text("", 256)
    plc, place = _READERS["plc"], _READERS["place"]
    if name not in _READERS:
        function = plc.function(name)

        def read(text):
            plc.memory.write(place, text.encode("latin-1") + b"\0")
            return function(place)

        _READERS[name] = read
    return _READERS[name]
