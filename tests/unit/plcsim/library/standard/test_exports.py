"""The string functions of IEC 61131-3; the first value of each is the norm's own example."""

import pytest

LONG = "x" * 200


@pytest.mark.parametrize(
    ("name", "arguments", "result"),
    [
        ("LEN", ("ASTRING",), 7),
        ("LEN", ("",), 0),
        ("LEFT", ("ASTR", 3), "AST"),
        ("LEFT", ("ASTR", 9), "ASTR"),
        ("LEFT", ("ASTR", -1), ""),
        ("RIGHT", ("ASTR", 3), "STR"),
        ("RIGHT", ("ASTR", 9), "ASTR"),
        ("RIGHT", ("ASTR", 0), ""),
        ("MID", ("ASTR", 2, 2), "ST"),
        ("MID", ("ASTR", 9, 3), "TR"),
        ("MID", ("ASTR", 1, 5), ""),
        ("MID", ("ASTR", 1, 0), ""),
        ("CONCAT", ("AB", "CD"), "ABCD"),
        ("CONCAT", (LONG, LONG), "x" * 255),
        ("INSERT", ("ABE", "CD", 2), "ABCDE"),
        ("INSERT", ("ABE", "CD", 0), "CDABE"),
        ("INSERT", ("ABE", "CD", 9), "ABECD"),
        ("INSERT", (LONG, LONG, 1), "x" * 255),
        ("DELETE", ("ABXYC", 2, 3), "ABC"),
        ("DELETE", ("ABC", 9, 2), "A"),
        ("DELETE", ("ABC", 1, 0), "ABC"),
        ("DELETE", ("ABC", 1, 9), "ABC"),
        ("DELETE", ("ABC", -1, 1), "ABC"),
        ("REPLACE", ("ABCDE", "X", 2, 3), "ABXE"),
        ("REPLACE", ("ABC", "XY", 0, 2), "AXYBC"),
        ("REPLACE", ("ABC", "XY", 9, 9), "ABCXY"),
        ("FIND", ("ABCBC", "BC"), 2),
        ("FIND", ("ABC", "X"), 0),
        ("FIND", ("ABC", ""), 0),
        ("FIND", ("BC", "ABC"), 0),
    ],
)
def test_values(plc, name, arguments, result):
    given = [plc.text(each) if isinstance(each, str) else each for each in arguments]
    assert plc.function(name)(*given) == result
