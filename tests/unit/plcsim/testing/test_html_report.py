"""The report of a run: page, JSON, JUnit, also with workers."""

import json
import re
import xml.etree.ElementTree as ET
from html.parser import HTMLParser

import pytest

from plcsim.testing.result import group_of

pytest_plugins = ["pytester"]

SUITE = """
    import pytest
    from plcsim import Program
    from st_types import BOOL, DINT, var

    class Worker(Program):
        n = var(DINT)
        odd = var(BOOL)

        def cyclic(self):
            self.n += 1
            self.odd = not self.odd

    pytestmark = pytest.mark.plc(program=Worker)

    def test_good(plc):
        plc.record("Worker.odd")
        plc.run("1s")

    def test_bad(plc):
        plc.assert_within("100ms", {"Worker.n": 50, "Worker.odd": "<no>" == "x"})

    def test_without_a_plc():
        pass
"""


class Reader(HTMLParser):
    """Checks that tags are closed; notes what would be loaded from elsewhere."""

    def __init__(self):
        super().__init__()
        self.open = []
        self.outside = []

    def handle_starttag(self, tag, attrs):
        self.outside += [v for k, v in attrs if k in ("src", "href")]
        if tag != "meta":  # the only element of the page that HTML leaves open
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_startendtag(self, tag, attrs):
        pass


@pytest.fixture
def report(pytester):
    def run(*arguments):
        pytester.makepyfile(SUITE)
        pytester.runpytest_inprocess(
            "-p", "no:hypothesispytest", "--plc-report=out", *arguments
        ).assert_outcomes(passed=2, failed=1)
        return pytester.path / "out"

    return run


def test_the_page_is_whole_and_needs_nothing_else(report):
    reader = Reader()
    text = (report() / "index.html").read_text()
    reader.feed(text)
    assert reader.open == []
    assert reader.outside == []
    assert text.index("test_bad") < text.index("test_good")
    assert "expected Worker.n = 50" in text
    assert text.count("<svg") == 4  # histogram and trace of both


def test_the_figures_are_there_as_json(report):
    whole = json.loads((report() / "report.json").read_text())
    good, bad = whole["tests"]
    assert (good["outcome"], bad["outcome"]) == ("passed", "failed")
    assert good["task_classes"][0]["cycles"] == 100
    assert good["programs"][0]["cycles"] == 100
    assert good["programs"][0]["median_in_loops"] > 0
    assert sum(count for _, count in good["programs"][0]["histogram"]) == 100
    assert bad["message"].startswith("expected Worker.n = 50")


def test_junit_properties(report, pytester):
    report("--junitxml=junit.xml")
    cases = {c.get("name"): c for c in ET.parse(pytester.path / "junit.xml").iter("testcase")}
    found = {p.get("name"): p.get("value") for p in cases["test_good"].iter("property")}
    assert found["plc.task_class.1.cycles"] == "100"
    assert found["plc.clock"] == "virtual"
    assert int(found["plc.program.Worker.cpu_p99_ns"]) > 0


def test_a_failure_leaves_its_trace_beside_the_report(report):
    names = sorted(p.name for p in (report() / "traces").iterdir())
    assert [re.sub(r".*py_", "", name) for name in names] == ["test_bad.csv", "test_bad.svg"]


def test_with_workers_the_report_is_the_same(report):
    pytest.importorskip("xdist")
    whole = json.loads((report("-n", "2") / "report.json").read_text())
    assert {t["test"].split("::")[1] for t in whole["tests"]} == {"test_good", "test_bad"}


@pytest.mark.parametrize(
    ("nodeid", "group"),
    [
        ("a.py::t", "a.py::t"),
        ("a.py::t[repeat3]", "a.py::t"),
        ("a.py::t[x-repeat12]", "a.py::t[x]"),
        ("a.py::t[seed+1-repeat0]", "a.py::t[seed+1]"),
        ("a.py::t[repeats]", "a.py::t[repeats]"),
    ],
)
def test_repeats_of_a_test_share_a_group(nodeid, group):
    assert group_of(nodeid) == group
