import pytest

from plcsim.modbus.map import TagMapError

from ..plants import controller, points

PLC = controller()


@pytest.mark.parametrize(
    ("tag", "kind", "registers", "access"),
    [
        ("p.flag", "?", 1, "rw"),
        ("p.small", "h", 1, "rw"),
        ("p.byte", "H", 1, "rw"),
        ("p.number", "h", 1, "rw"),
        ("p.word", "H", 1, "rw"),
        ("p.long", "i", 2, "rw"),
        ("p.huge", "q", 4, "rw"),
        ("p.real", "f", 2, "rw"),
        ("p.double", "d", 4, "rw"),
        ("p.duration", "i", 2, "rw"),
        ("p.mode", "i", 2, "rw"),
        ("p.percent", "h", 1, "rw"),
        ("p.text", "s", 5, "rw"),
        ("P.AXES[2].POSITION", "i", 2, "rw"),
    ],
)
def test_type_and_length_follow_the_variable(
    tag: str, kind: str, registers: int, access: str
) -> None:
    (point,) = points(PLC, f"{tag},hr,10")
    assert (point.kind, point.registers, point.access) == (kind, registers, access)
    assert point.address == PLC.tags.find(tag).address


def test_inputs_are_read_only_and_subranges_are_limits() -> None:
    (point,) = points(PLC, "p.percent,ir,0")
    assert point.access == "ro"
    assert (point.minimum, point.maximum) == (0, 100)
    (point,) = points(PLC, "p.percent,hr,0,,,,,,,,10,200")
    assert (point.minimum, point.maximum) == (10, 100)


def test_the_order_of_the_file_holds_where_the_row_gives_none() -> None:
    first, second = points(PLC, "p.long,hr,0", "p.big,hr,2,,,,BADC", order="CDAB")
    assert (first.order, second.order) == ("CDAB", "BADC")


@pytest.mark.parametrize(
    ("lines", "error"),
    [
        (["p.flga,hr,0"], r"tags.csv:2: p.flga: no tag .*did you mean p.flag"),
        (["p.flag,co,0", "q.x,hr,0"], "tags.csv:3: q.x: no program 'q'"),
        (["p.axes[1],hr,0"], "cannot lie in registers"),
        (["p.wide,hr,0"], "cannot lie in registers"),
        (["p.number,co,0"], "only a BOOL can lie in area co"),
        (["p.number,hr,0,3"], "only a BOOL in a register has a bit"),
        (["p.flag,co,0,3"], "only a BOOL in a register has a bit"),
        (["p.number,hr,0,,bool"], "the type bool is for a BOOL"),
        (["p.flag,co,0,,uint16"], "only a BOOL can lie in area co"),
        (["p.text,hr,0,,int16"], "a STRING needs the type string"),
        (["p.number,hr,0,,string"], "a STRING needs the type string"),
        (["p.long,hr,0,,int16"], "holds -32768 to 32767, the variable -2147483648 to 2147483647"),
        (["p.real,hr,0,,int32"], "needs a scale"),
        (["p.number,hr,0,,uint32"], "holds 0 to 4294967295, the variable -32768 to 32767"),
        (["p.small,hr,0,,uint16"], "holds 0 to 65535, the variable -128 to 127"),
        (["p.text,hr,0,,,124"], "no request writes more than 123 registers"),
        (["p.flag,hr,0,,,,,,2"], "scale, offset_eu, min and max are for numbers"),
        (["p.number,hr,0,,,,,,,,5,4"], "min is above max"),
        (["p.number,hr,0,,,2"], "length is for strings"),
        (["p.flag,di,0,,,,,rw"], "area di cannot be written"),
        (["p.number,ir,0,,,,,wo"], "area ir cannot be written"),
        (["p.vast,hr,65533"], "do not fit below 65536"),
        (["p.number,ir,65000"], "hold the status block"),
        (["p.vast,ir,64998"], "hold the status block"),
        (["p.number,hr,0,,,,,,0.1,,,,,1"], "partial is for tags without scale"),
        (["p.long,hr,0", "p.number,hr,1"], r"tags.csv:3: p.number: overlaps p.long \(line 2\)"),
        (["p.flag,hr,0,1", "p.other,hr,0,1"], "overlaps p.flag"),
        (["p.flag,hr,0,1", "p.number,hr,0"], "overlaps p.flag"),
        (["p.flag,co,9", "p.other,co,9"], "overlaps p.flag"),
    ],
)
def test_a_row_that_does_not_fit_is_named_with_its_line(lines: list[str], error: str) -> None:
    with pytest.raises(TagMapError, match=error):
        points(PLC, *lines)


@pytest.mark.parametrize(
    "lines",
    [
        ["p.flag,hr,0,1", "p.other,hr,0,2"],
        ["p.long,hr,0", "p.number,hr,1,,,,,,,,,,1"],
        ["p.number,hr,0,,,,,,,,,,1", "p.long,hr,0"],
        ["p.flag,co,0", "p.other,di,0", "p.number,ir,0", "p.count,hr,0"],
        ["p.number,ir,64999", "p.count,ir,65021"],
        ["p.number,hr,65535"],
        ["p.number,hr,0,,uint16", "p.percent,hr,1,,uint32", "p.mode,hr,3,,uint16"],
        ["p.text,ir,0,,,125", "p.text,hr,0,,,123"],
    ],
)
def test_rows_that_share_no_bit_or_say_so_are_right(lines: list[str]) -> None:
    assert len(points(PLC, *lines)) == len(lines)
