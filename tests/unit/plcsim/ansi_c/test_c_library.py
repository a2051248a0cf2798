import ctypes
import ctypes.util

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.c_library import (
    BINARY,
    MUSL,
    OPTIONS,
    STAMP,
    CLibrary,
    linked_library,
    sources,
    stamp,
)
from plcsim.ansi_c.headers import INCLUDE
from plcsim.core.memory import FIRST, LIBRARY_AREA, PAGE, Memory
from plcsim.machine import CodeCache, Machine, MachineFault

HOST = ctypes.CDLL(ctypes.util.find_library("c"))


class World:
    """The C library on a memory of 16 pages, 2 of them valid."""

    def __init__(self):
        self.memory = Memory(16 * PAGE)
        self.memory.allocate(2 * PAGE)
        self.library = CLibrary(Machine(self.memory, cache=CodeCache(None)))

    def call(self, name, *values, params="II", results="i"):
        return self.library.function(name, params[: len(values)], results)(*values)

    def text(self, address, data):
        self.memory.write(address, data + b"\0")
        return address


WORLD = World()


def test_the_binary_is_that_of_the_sources():
    """After a change of the sources: python tools/build_c_library.py."""
    assert linked_library().section(STAMP) == stamp()


def test_each_compiler_builds_it_without_a_warning(each_toolchain):
    order = BuildOrder("C library", sources(), [MUSL, INCLUDE], OPTIONS)
    assert build(order, each_toolchain, CodeCache(None)).warnings == []


def test_it_needs_little_and_its_data_fits_its_page():
    library = linked_library()
    assert all(name.startswith("plc_") for name in library.called)
    assert library.memory_size <= PAGE
    assert BINARY.stat().st_size < 200_000


texts = st.binary(max_size=40).map(lambda data: data.replace(b"\0", b"~"))
few = st.binary(max_size=12).map(lambda data: bytes(b % 3 + 97 for b in data))


def sign(number):
    return (number > 0) - (number < 0)


@pytest.mark.parametrize("name", ["strcmp", "strcoll"])
@given(a=texts | few, b=texts | few)
def test_comparisons_have_the_sign_of_the_host_s(name, a, b):
    first, second = WORLD.text(FIRST, a), WORLD.text(FIRST + 100, b)
    assert sign(WORLD.call(name, first, second)) == sign(getattr(HOST, name)(a, b))


@pytest.mark.parametrize("name", ["strncmp", "memcmp", "strncasecmp"])
@given(a=few, b=few, count=st.integers(0, 14))
def test_bounded_comparisons_have_the_sign_of_the_host_s(name, a, b, count):
    a, b = a.ljust(16, b"\0"), b.ljust(16, b"\0")
    first, second = WORLD.text(FIRST, a), WORLD.text(FIRST + 100, b)
    found = WORLD.call(name, first, second, count, params="III")
    assert sign(found) == sign(getattr(HOST, name)(a, b, count))


@pytest.mark.parametrize("name", ["strlen", "strspn", "strcspn"])
@given(a=few, b=few)
def test_lengths_are_those_of_the_host(name, a, b):
    first, second = WORLD.text(FIRST, a), WORLD.text(FIRST + 100, b)
    values = [first] if name == "strlen" else [first, second]
    assert WORLD.call(name, *values) == getattr(HOST, name)(*[a, b][: len(values)])


@pytest.mark.parametrize("name", ["strchr", "strrchr", "memchr"])
@given(a=few, character=st.integers(96, 100) | st.just(0))
def test_characters_are_found_where_the_host_finds_them(name, a, character):
    address = WORLD.text(FIRST, a)
    values = [address, character, *([len(a) + 1] if name == "memchr" else [])]
    found = WORLD.call(name, *values, params="III", results="I")
    places = {"strrchr": (a + b"\0").rfind}.get(name, (a + b"\0").find)
    place = places(bytes([character]))
    assert found == (address + place if place >= 0 else 0)


@given(a=few, b=few.map(lambda b: b[:3]))
def test_parts_are_found_where_they_first_are(a, b):
    address = WORLD.text(FIRST, a)
    found = WORLD.call("strstr", address, WORLD.text(FIRST + 100, b), results="I")
    assert found == (address + a.find(b) if b in a else 0)


@given(st.integers(0, 60), st.integers(0, 60), st.integers(0, 40))
def test_memmove_copies_over_itself(source, target, count):
    data = bytes(range(100))
    WORLD.memory.write(FIRST, data)
    WORLD.call("memmove", FIRST + target, FIRST + source, count, params="III")
    expected = bytearray(data)
    expected[target : target + count] = data[source : source + count]
    assert WORLD.memory.read(FIRST, 100) == bytes(expected)


@given(st.integers(0, 20), st.integers(0, 40), st.integers(-300, 300))
def test_memset_fills_what_it_is_given_and_no_more(start, count, value):
    WORLD.memory.write(FIRST, b"\x55" * 80)
    WORLD.call("memset", FIRST + start, value, count, params="IiI")
    expected = b"\x55" * start + bytes([value & 0xFF]) * count
    assert WORLD.memory.read(FIRST, 80) == expected.ljust(80, b"\x55")


@given(texts, st.integers(0, 45))
def test_strncpy_pads_and_does_not_terminate(a, count):
    WORLD.memory.write(FIRST + 100, b"\x55" * 60)
    WORLD.call("strncpy", FIRST + 100, WORLD.text(FIRST, a), count, params="III")
    assert WORLD.memory.read(FIRST + 100, 60) == a[:count].ljust(count, b"\0").ljust(60, b"\x55")


@given(texts, texts, st.integers(0, 45))
def test_texts_are_joined(a, b, count):
    target, source = WORLD.text(FIRST, a), WORLD.text(FIRST + 100, b)
    assert WORLD.call("strcat", target, source, results="I") == target
    assert WORLD.memory.string(target, 100) == a + b
    WORLD.text(FIRST, a)
    WORLD.call("strncat", target, source, count, params="III")
    assert WORLD.memory.string(target, 100) == a + b[:count]


@given(texts)
def test_letters_of_ascii_become_small_and_large_in_place(a):
    for name, method in (("strlwr", bytes.lower), ("strupr", bytes.upper)):
        target = WORLD.text(FIRST, a)
        assert WORLD.call(name, target, results="I") == target
        assert WORLD.memory.string(target, 100) == method(a)


def test_words_are_cut_off_one_by_one():
    text, separators = WORLD.text(FIRST, b",,one, two,;three;"), WORLD.text(FIRST + 50, b",; ")
    words, at = [], WORLD.call("strtok", text, separators, results="I")
    while at:
        words.append(WORLD.memory.string(at, 20))
        at = WORLD.call("strtok", 0, separators, results="I")
    assert words == [b"one", b"two", b"three"]


def test_a_reset_forgets_what_strtok_was_at():
    WORLD.call("strtok", WORLD.text(FIRST, b"a b c"), WORLD.text(FIRST + 50, b" "), results="I")
    WORLD.library.reset()
    assert WORLD.call("strtok", 0, FIRST + 50, results="I") == 0


KINDS = ["alnum", "alpha", "blank", "cntrl", "digit", "graph", "lower", "print", "punct", "space"]


@pytest.mark.parametrize("name", [*(f"is{k}" for k in KINDS), "isupper", "isxdigit"])
def test_kinds_of_characters_are_those_of_the_host(name):
    ours = WORLD.library.function(name)
    assert [bool(ours(c)) for c in range(-1, 256)] == [
        bool(getattr(HOST, name)(c)) for c in range(-1, 256)
    ]


@pytest.mark.parametrize("name", ["tolower", "toupper"])
def test_letters_change_their_case(name):
    ours = WORLD.library.function(name)
    assert [ours(c) for c in range(-1, 256)] == [getattr(HOST, name)(c) for c in range(-1, 256)]


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("strlen", (0,)),
        ("strcpy", (0, FIRST)),
        ("strcpy", (FIRST, 4)),
        ("memcpy", (FIRST, FIRST, 0xFFFF_FFFF)),
        ("memset", (FIRST + 2 * PAGE - 10, 0, 11)),
        ("memmove", (FIRST, FIRST + 2 * PAGE - 4, 5)),
        ("memcmp", (FIRST, 8, 4)),
    ],
)
def test_what_lies_nowhere_is_a_page_fault_and_the_library_goes_on(name, values):
    with pytest.raises(MachineFault, match="page fault"):
        WORLD.call(name, *values, params="III")
    assert WORLD.call("strlen", WORLD.text(FIRST, b"abc")) == 3


def test_what_does_not_exist_is_none():
    assert WORLD.library.extern("no_such_function") is None
    assert WORLD.library.extern("strlen") is WORLD.library.extern("strlen")


def test_it_lies_in_its_own_page():
    assert WORLD.library._module.address == LIBRARY_AREA
