"""Direct addresses."""

import pytest

from plcsim.program.structured_text.check.located import DirectPlace, direct_place, values_in
from st_types.types.derived import ArrayType, Member, StructType
from st_types.types.elementary import BOOL, BYTE, DWORD, INT, LWORD, WORD


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("%IX0.0", DirectPlace("I", 0, 0, BOOL)),
        ("%q12.7", DirectPlace("Q", 12, 7, BOOL)),
        ("%QX19", DirectPlace("Q", 2, 3, BOOL)),
        ("%MB5", DirectPlace("M", 5, None, BYTE)),
        ("%mw10", DirectPlace("M", 20, None, WORD)),
        ("%ID3", DirectPlace("I", 12, None, DWORD)),
        ("%ML2", DirectPlace("M", 16, None, LWORD)),
        ("%MB65535", DirectPlace("M", 65535, None, BYTE)),
        ("%MB65536", None),
        ("%MW32768", None),
        ("%MW1.2", None),
        ("%IX0.8", None),
        ("%I*", None),
        ('%IX."A".B', None),
    ],
)
def test_places(text, expected):
    assert direct_place(text) == expected


def test_single_values_are_counted():
    pair = StructType("Pair", [Member("a", INT), Member("b", ArrayType(BOOL, [(0, 3)]))])
    assert values_in(ArrayType(pair, [(1, 2), (1, 3)])) == 30
