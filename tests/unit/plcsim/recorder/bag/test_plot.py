import re
from xml.etree import ElementTree as ET

import pytest

from plcsim.core.tag import Tag
from plcsim.recorder.bag.plot import draw, page
from plcsim.recorder.bag.series import Series
from st_types import BOOL, REAL

MS = 1_000_000


def picture(*points: tuple[int, float | bool], path: str = "tank.level") -> ET.Element:
    kind = BOOL if isinstance(points[0][1], bool) else REAL
    return ET.fromstring(draw([Series(Tag(path, kind, 0), list(points))], "a <title>"))


def line(found: ET.Element) -> str:
    (path,) = found.iter("{http://www.w3.org/2000/svg}path")
    return path.attrib["d"]


def texts(found: ET.Element) -> list[str]:
    return [each.text or "" for each in found.iter("{http://www.w3.org/2000/svg}text")]


def test_a_picture_names_tag_bounds_and_times() -> None:
    found = texts(picture((0, 1.5), (500 * MS, 4.25), (1000 * MS, 4.25)))

    assert {"a <title>", "tank.level", "1.5", "4.25", "0", "1 s"} <= set(found)


def test_values_stand_until_they_change() -> None:
    assert re.fullmatch(
        r"M190\.0 (\S+?)V\1H585\.0V(\S+?)H980\.0V\2H980\.0",
        line(picture((0, 0.0), (500 * MS, 1.0), (1000 * MS, 1.0))),
    )


def test_many_changes_in_one_pixel_are_few_words() -> None:
    points = [(n, float(n % 7)) for n in range(100_000)]

    assert len(line(picture(*points))) < 60_000


def test_a_tag_that_never_changes_is_a_line_with_one_value() -> None:
    found = texts(picture((0, 7.0), (1000 * MS, 7.0)))

    assert found.count("7") == 1


@pytest.mark.parametrize("value", [True, False])
def test_a_bool_has_no_bounds(value: bool) -> None:
    found = texts(picture((0, value), (1000 * MS, value)))

    assert found[0] == "a <title>"
    assert "1" not in found


def test_a_page_holds_the_picture() -> None:
    assert "<svg/>" in page("<svg/>", "a <title>")
    assert "a &lt;title&gt;" in page("<svg/>", "a <title>")
