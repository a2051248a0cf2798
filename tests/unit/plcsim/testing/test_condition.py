"""Conditions: what they accept, what they read, how they are named in a failure."""

import pytest

from plcsim.core.errors import TagError
from plcsim.testing import PlcTestError
from plcsim.testing.condition import Condition, source_of


def named():
    return True


def test_a_tag_is_true_where_it_is_not_0(cell_plc):
    condition = Condition("Cell.count", cell_plc.tags)
    assert not condition.holds()
    cell_plc.cycles()
    assert condition.holds()
    assert (condition.text, list(condition.paths)) == ("Cell.count", ["Cell.count"])


def test_a_mapping_wants_all_of_its_values(cell_plc):
    condition = Condition({"Cell.light": "RED", "Cell.start": True}, cell_plc.tags)
    assert not condition.holds()
    cell_plc["Cell.start"] = True
    assert condition.holds()
    assert condition.text == "Cell.light = RED and Cell.start = TRUE"


def test_a_function_is_named_by_its_text_and_notes_what_it_reads(cell_plc):
    condition = Condition(
        lambda: cell_plc["Cell.count"] > 2 or cell_plc["Cell.start"], cell_plc.tags
    )
    assert not condition.holds()
    assert condition.text == 'cell_plc["Cell.count"] > 2 or cell_plc["Cell.start"]'
    assert list(condition.paths) == ["Cell.count", "Cell.start"]


@pytest.mark.parametrize(
    ("function", "text"),
    [
        (named, "named"),
        (lambda: len([]) + 2, "len([]) + 2"),
        (lambda: len("ä") > 2, 'len("ä") > 2'),
        (
            lambda: (
                len([])
                + 2
            ),
            "the condition at line",
        ),
        (len, "len"),
    ],
)  # fmt: skip
def test_names_of_functions(function, text):
    assert source_of(function).startswith(text)


@pytest.mark.parametrize("given", [3, None, ["Cell.count"]])
def test_what_is_no_condition(cell_plc, given):
    with pytest.raises(PlcTestError, match="is no condition"):
        Condition(given, cell_plc.tags)


@pytest.mark.parametrize("given", ["Cell.coutn", {"Cell.coutn": 1}, {"Cell.start": 3}])
def test_wrong_tags_and_values_are_found_at_once(cell_plc, given):
    with pytest.raises(TagError):
        Condition(given, cell_plc.tags)
