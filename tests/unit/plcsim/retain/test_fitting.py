"""What fits by name and type is taken from another program version, the rest is told."""

import struct

from plcsim.core.tag import Tag
from plcsim.retain.fitting import fit
from plcsim.retain.generations import Generation
from st_types import ARRAY, INT, REAL, UDINT, Struct, var
from st_types.types.derived import ReferenceType
from st_types.types.views import type_of


class Old(Struct):
    speed = var(REAL)
    gone = var(INT)
    count = var(INT)


class New(Struct):
    count = var(INT)
    added = var(INT)
    speed = var(REAL)


def generation(*variables):
    data, tags = b"", []
    for path, data_type, value in variables:
        tags.append(Tag(path, data_type, len(data)))
        data += value
    return Generation(1, tags, data)


def test_members_find_their_new_places():
    old = generation(("m.axis", type_of(Old), struct.pack("<fhh", 1.5, 7, 9)))
    found = fit(old, [Tag("m.axis", type_of(New), 1000)])
    assert found.taken == [(1004, struct.pack("<f", 1.5)), (1000, struct.pack("<h", 9))]
    assert found.left == ["m.axis.gone: there is no such retained variable"]


def test_another_type_is_not_taken():
    old = generation(("m.x", INT, b"ab"), ("m.y", INT, b"cd"))
    found = fit(old, [Tag("m.x", UDINT, 1000), Tag("m.y", INT, 1004)])
    assert found.taken == [(1004, b"cd")]
    assert found.left == ["m.x: it was INT and is UDINT"]


def test_elements_that_are_still_there_are_taken_as_one():
    old = generation(("m.table", ARRAY(INT, (0, 3)), b"aabbccdd"))
    found = fit(old, [Tag("m.table", ARRAY(INT, (1, 2)), 1000)])
    assert found.taken == [(1000, b"bbcc")]
    assert [line.partition(":")[0] for line in found.left] == ["m.table[0]", "m.table[3]"]


def test_what_was_retained_alone_is_found_in_a_struct_that_now_is():
    old = generation(("m.axis.count", INT, b"ab"))
    assert fit(old, [Tag("m.axis", type_of(New), 1000)]).taken == [(1000, b"ab")]


def test_an_address_is_not_taken():
    old = generation(("m.place", UDINT, b"\0\0\x12\0"))
    found = fit(old, [Tag("m.place", ReferenceType(INT), 1000)])
    assert (found.taken, found.left) == ([], ["m.place: an address is not kept"])
