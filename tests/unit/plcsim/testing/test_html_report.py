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
    from plcsim.core.heap_use import Heaps, HeapUse
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
        Heaps.of(plc.controller.context).add("Worker", lambda: HeapUse(9000, 24, 1048, 3, 0))
        plc.run("1s")

    def test_bad(plc):
        plc.assert_within("100ms", {"Worker.n": 50, "Worker.odd": "<no>" == "x"})

    def test_restarted(plc):
        plc.run("1s")
        plc.restart()

    def test_plain(plc):
        plc.run("50ms")
        assert plc["Worker.n"] == 7, "too few"

    def test_without_a_plc():
        pass

    def test_without_a_plc_that_fails():
        assert "one" == "two"

    @pytest.mark.skip(reason="not <yet>")
    def test_skipped():
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
        ).assert_outcomes(passed=3, failed=3, skipped=1)
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
    assert text.count("<svg") == 7  # four histograms, and traces of three tests
    assert "not &lt;yet&gt;" in text
    assert "<td>Worker</td><td>9,000</td><td>1,048</td><td>24</td><td>3</td><td>0</td>" in text


def test_the_figures_are_there_as_json(report):
    whole = json.loads((report() / "report.json").read_text())
    good, bad, *_ = whole["tests"]
    assert (good["outcome"], bad["outcome"]) == ("passed", "failed")
    assert good["task_classes"][0]["cycles"] == 100
    assert good["programs"][0]["cycles"] == 100
    assert good["programs"][0]["median_in_loops"] > 0
    assert sum(count for _, count in good["programs"][0]["histogram"]) == 100
    assert bad["message"].startswith("expected Worker.n = 50")


def by_name(whole, key):
    return {test["test"].split("::")[1]: test for test in whole[key]}


def test_time_before_a_restart_counts(report):
    whole = json.loads((report() / "report.json").read_text())
    assert by_name(whole, "tests")["test_restarted"]["time_ns"] == 1_000_000_000


def test_a_plain_assert_has_its_line_and_the_last_cycles(report):
    test = by_name(json.loads((report() / "report.json").read_text()), "tests")["test_plain"]
    location, _, line = test["location"].rpartition(":")
    assert location.endswith(".py")
    assert int(line) > 1
    assert test["source"] == 'assert plc["Worker.n"] == 7, "too few"'
    assert test["message"] == "AssertionError: too few\nassert 5 == 7"
    assert test["explanation"].startswith("the last 5 cycles")
    assert "trace: out/traces/" in test["explanation"]


def test_tests_without_a_controller_are_listed_too(report):
    folder = report()
    others = by_name(json.loads((folder / "report.json").read_text()), "others")
    assert {name: test["outcome"] for name, test in others.items()} == {
        "test_without_a_plc": "passed",
        "test_without_a_plc_that_fails": "failed",
        "test_skipped": "skipped",
    }
    assert others["test_without_a_plc_that_fails"]["source"] == 'assert "one" == "two"'
    assert others["test_skipped"]["message"] == "Skipped: not <yet>"
    text = (folder / "index.html").read_text()
    assert text.index("test_without_a_plc_that_fails") < text.index("test_good")
    assert '<b class="skipped">1</b>skipped' in text


def test_junit_properties(report, pytester):
    report("--junitxml=junit.xml")
    cases = {c.get("name"): c for c in ET.parse(pytester.path / "junit.xml").iter("testcase")}
    found = {p.get("name"): p.get("value") for p in cases["test_good"].iter("property")}
    assert found["plc.task_class.1.cycles"] == "100"
    assert found["plc.clock"] == "virtual"
    assert int(found["plc.program.Worker.cpu_p99_ns"]) > 0


def test_a_failure_leaves_its_trace_beside_the_report(report):
    names = sorted(p.name for p in (report() / "traces").iterdir())
    files = ["test_bad.csv", "test_bad.svg", "test_plain.csv", "test_plain.svg"]
    assert [re.sub(r".*py_", "", name) for name in names] == files


def test_with_workers_the_report_is_the_same(report):
    pytest.importorskip("xdist")
    whole = json.loads((report("-n", "2") / "report.json").read_text())
    names = {"test_good", "test_bad", "test_restarted", "test_plain"}
    assert set(by_name(whole, "tests")) == names
    assert len(by_name(whole, "others")) == 3


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
