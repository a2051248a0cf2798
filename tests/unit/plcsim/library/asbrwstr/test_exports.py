"""AsBrWStr: values by hand."""

import pytest

from plcsim.library.asbrwstr import brwU8toUC, brwUCtoU8


@pytest.fixture
def wide(plc):
    """``wide(text)``: store a WSTRING with room behind it; return its address."""
    return lambda text: plc.bytes(text.encode("utf-16-le") + bytes(80))


@pytest.fixture
def read(plc):
    """``read(address)``: the WSTRING there."""

    def read(address):
        data = plc.memory.read(address, 80)
        characters = [data[i : i + 2] for i in range(0, 80, 2)]
        return b"".join(characters[: characters.index(b"\0\0")]).decode("utf-16-le")

    return read


def test_copying_and_appending(plc, wide, read):
    target = wide("")
    assert plc.function("brwcscpy")(target, wide("käse")) == target
    assert plc.function("brwcscat")(target, wide("ω")) == target
    assert read(target) == "käseω"
    assert plc.function("brwcslen")(target) == 5
    assert plc.function("brwcsncat")(target, wide("12345"), 2) == target
    assert read(target) == "käseω12"


def test_copying_a_number_of_characters(plc, wide, read):
    target = wide("#######")
    assert plc.function("brwcsncpy")(target, wide("abcdef"), 3) == target
    assert read(target) == "abc####"
    plc.function("brwcsncpy")(target, wide("x"), 3)
    assert plc.memory.read(target, 8) == b"x\0\0\0\0\0#\0"


def test_comparisons(plc, wide):
    compare, part = plc.function("brwcscmp"), plc.function("brwcsncmp")
    assert compare(wide("ab"), wide("ab")) == 0
    assert compare(wide("ab"), wide("aω")) < 0 < compare(wide("abc"), wide("ab"))
    assert part(wide("abX"), wide("abY"), 2) == 0
    assert part(wide("abX"), wide("abY"), 3) < 0
    assert part(wide("a"), wide("b"), 0) == 0


def test_finding(plc, wide):
    text = wide("abcab")
    assert plc.function("brwcschr")(text, ord("b")) == text + 2
    assert plc.function("brwcsrchr")(text, ord("b")) == text + 8
    assert plc.function("brwcschr")(text, ord("x")) == 0
    assert plc.function("brwcsrchr")(text, ord("x")) == 0
    assert plc.function("brwcschr")(text, 0) == text + 10


def test_filling(plc, wide, read):
    target = wide("abcd")
    assert plc.function("brwcsset")(target, 2, ord("ω")) == target
    assert read(target) == "ωωcd"


def test_between_string_and_wstring(plc, wide, read):
    target = wide("")
    convert = plc.function("brwcsconv")
    assert convert(target, plc.text("käse"), brwU8toUC) == target
    assert read(target) == "käse"
    narrow = plc.text("########")
    convert(narrow, wide("käω"), brwUCtoU8)
    assert plc.string(narrow) == "kä?"
