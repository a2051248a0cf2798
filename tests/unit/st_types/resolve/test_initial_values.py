import pytest

from st_types.resolve import initial_values
from st_types.syntax.declarations import parse_text

from ..checked import checked

KNOWN = """\
TYPE
    Colour : (red, green := 5);
    Point : STRUCT x : INT := 3; y : REAL; n : ARRAY[0..2] OF INT; END_STRUCT;
    Timer : Block;
END_TYPE
VAR CONSTANT
    MAX : USINT := 200;
    RATE : REAL := 0.5;
    WHO : STRING[5] := 'me';
    LIST : ARRAY[0..1] OF INT := [1, 2];
END_VAR
FUNCTION_BLOCK Block VAR_INPUT PT : TIME; END_VAR END_FUNCTION_BLOCK
"""


def resolved(specification: str, value: str) -> tuple[object, list[str]]:
    file = parse_text(
        f"{KNOWN}VAR v : {specification} := {value}; END_VAR",
        "a.var",
    )
    table = checked([file])
    return table.variables[-1].initial, [str(record) for record in file.diagnostics.records]


@pytest.mark.parametrize(
    ("specification", "value", "expected"),
    [
        ("BOOL", "TRUE", True),
        ("BOOL", "0", False),
        ("BOOL", "MAX > 100", True),
        ("INT", "-32768", -32768),
        ("INT", "16#FFFF", -1),
        ("INT", "MAX - 1", 199),
        ("UINT", "TRUE", 1),
        ("UDINT", "5.0", 5),
        ("BYTE", "BYTE#16#FF", 255),
        ("LWORD", "16#FFFF_FFFF_FFFF_FFFF", 2**64 - 1),
        ("REAL", "1", 1.0),
        ("REAL", "MAX * RATE", 100.0),
        ("LREAL", "-1.5E300", -1.5e300),
        ("TIME", "T#1m", 60_000),
        ("TIME", "500", 500),
        ("DATE", "D#1970-01-02", 86_400),
        ("TOD", "TOD#00:00:01", 1000),
        ("DT", "DT#1970-01-01-00:01:00", 60),
        ("STRING[5]", "'a$'b'", "a'b"),
        ("STRING[5]", "WHO", "me"),
        ("STRING[5]", "'grün'", "grün"),
        ("STRING[5]", "'€'", "â\x82¬"),
        ("STRING[5]", "0", None),
        ("ARRAY[0..1] OF STRING[5]", "[2(0)]", [None, None]),
        ("WSTRING[5]", '"€"', "€"),
        ("WSTRING[5]", "'x'", "x"),
        ("Colour", "green", 5),
        ("Colour", "Colour.green", 5),
        ("Colour", "Colour#red", 0),
        ("Colour", "7", 7),
        ("INT", "green + 1", 6),
        ("INT(1..9)", "9", 9),
        ("Point", "(x := 5, n := [1, 2(7)])", {"x": 5, "n": [1, 7, 7]}),
        ("Point", "()", {}),
        ("Point", "(0)", None),
        ("Timer", "(PT := T#1s)", {"PT": 1000}),
        ("ARRAY[0..3] OF INT", "[1, 2]", [1, 2]),
        ("ARRAY[0..3] OF INT", "[2(1), 2()]", [1, 1, None, None]),
        ("ARRAY[0..3] OF INT", "[2(1, 2)]", [1, 2, 1, 2]),
        ("ARRAY[0..3] OF INT", "4(9)", [9, 9, 9, 9]),
        ("ARRAY[0..3] OF INT", "(0)", None),
        ("ARRAY[0..199] OF BOOL", "[MAX(TRUE)]", [True] * 200),
        ("ARRAY[0..1, 0..1] OF INT", "[[1, 2], [3, 4]]", [1, 2, 3, 4]),
        ("ARRAY[0..1, 0..1] OF INT", "[1, 2, 3, 4]", [1, 2, 3, 4]),
        ("ARRAY[0..1] OF ARRAY[0..1] OF INT", "[[1, 2], [3]]", [[1, 2], [3]]),
        ("ARRAY[0..1] OF Point", "[2((x := 1))]", [{"x": 1}, {"x": 1}]),
        ("REFERENCE TO INT", "ADR(x)", None),
        ("REFERENCE TO INT", "0", None),
    ],
)
def test_values(specification: str, value: str, expected: object) -> None:
    found, findings = resolved(specification, value)
    assert findings == []
    assert found == expected
    assert type(found) is type(expected)


@pytest.mark.parametrize(
    ("specification", "value", "stored", "message"),
    [
        ("USINT", "-1", 255, "warning: -1 does not fit USINT; the controller stores 255"),
        ("SINT", "200", -56, "warning: 200 does not fit SINT; the controller stores -56"),
        ("STRING[3]", "'abcd'", "abc", "warning: 4 characters are given, STRING[3] holds 3; the"),
        ("WSTRING[3]", '"abcd"', "abc", "warning: 4 characters are given, WSTRING[3] holds 3"),
        ("INT", "ADR(x)", None, "warning: the value is not known here; a constant was expected"),
        ("INT", "NONE", None, "warning: no constant is called NONE"),
        ("INT", "Point.x", None, "warning: no constant is called Point.x"),
        ("USINT", "256", None, "error: 256 is outside 0..255 of USINT"),
        ("INT", "-32769", None, "error: -32769 is outside -32768..32767 of INT"),
        ("TIME", "T#25d", None, "warning: 2160000000 does not fit TIME"),
        ("INT", "1.5", None, "error: 1.5 is not a value of INT"),
        ("INT", "'x'", None, "error: 'x' is not a value of INT"),
        ("STRING[3]", "5", None, "error: 5 is not a value of STRING[3]"),
        ("BOOL", "2", None, "error: 2 is not a value of BOOL"),
        ("REAL", "'x'", None, "error: 'x' is not a value of REAL"),
        ("REAL", "1E39", None, "error: 1e+39 is too large for REAL"),
        ("Colour", "1.5", None, "error: 1.5 is not a value of Colour"),
        ("Colour", "16#1_0000_0000", None, "error: 4294967296 is outside -2147483648..2147483647"),
        ("INT(1..9)", "10", None, "error: 10 is outside 1..9 of v"),
        ("Point", "5", None, "error: 5 is not a value of Point"),
        ("Point", "[1]", None, "error: Point cannot have a list of values as its initial value"),
        ("INT", "(x := 1)", None, "error: INT cannot have members as its initial value"),
        ("Point", "(z := 1)", {}, "error: Point has no member z"),
        ("Point", "(X := 2)", {"x": 2}, "warning: X is declared as x; names differ in case"),
        ("Point", "(x := 1, x := 2)", {"x": 2}, "error: the member x is given twice"),
        (
            "ARRAY[0..1] OF INT",
            "[1, 2, 3]",
            [1, 2],
            "error: too many values for ARRAY[0..1] OF INT",
        ),
        (
            "ARRAY[0..1] OF INT",
            "[3(0)]",
            [],
            "error: too many values for ARRAY[0..1] OF INT; it ta",
        ),
        ("ARRAY[0..1] OF INT", "[2000000000(0)]", [], "error: too many values"),
        ("ARRAY[0..1] OF INT", "[LIST(0)]", [], None),
    ],
)
def test_findings(specification: str, value: str, stored: object, message: str | None) -> None:
    found, findings = resolved(specification, value)
    if message is None:
        assert findings == []  # a list has no value as a number; that is not known here
    else:
        assert len(findings) == 1, findings
        assert message in findings[0]
    if stored is not None:
        assert found == stored


def test_a_hostile_file_cannot_fill_the_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(initial_values, "MAX_ELEMENTS", 1000)
    monkeypatch.setattr("st_types.resolve.constant_resolver.MAX_ELEMENTS", 1000)
    _, findings = resolved("ARRAY[0..2000000000] OF BYTE", "[1000000000(1)]")
    assert "it takes 1000" in findings[0]
    values = " ".join(f"v{i} : ARRAY[0..99] OF BYTE := [100(1)];" for i in range(11))
    file = parse_text(f"VAR {values} END_VAR", "a.var")
    checked([file])
    assert [r.message for r in file.diagnostics.records] == [
        "the file gives more than 1000 initial values"
    ]
