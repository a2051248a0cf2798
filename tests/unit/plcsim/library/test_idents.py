"""Idents are given once."""

from plcsim.library.idents import LAST_IDENT, Idents


def test_an_ident_is_not_given_again():
    idents = Idents(None, most=2)
    first = idents.add("a")
    assert idents.remove(first) == "a"
    second = idents.add("b")
    assert first != second
    assert (idents.find(first), idents.find(second)) == (None, "b")
    assert idents.remove(first) is None


def test_full():
    idents = Idents(None, most=2)
    idents.add("a")
    assert not idents.full
    idents.add("b")
    assert idents.full
    assert [found for _, found in idents] == ["a", "b"]


def test_idents_wrap_around_those_in_use():
    idents = Idents(None)
    first = idents.add("a")
    idents._last = LAST_IDENT
    assert idents.add("b") == first + 1
