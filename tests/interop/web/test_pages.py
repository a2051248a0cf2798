"""What a person does with the pages, in Chromium: each act is seen to reach the controller."""

import json
import re
import urllib.request
from pathlib import Path

import pytest

from plcsim.access import Role, Users
from plcsim.access.users import users_file
from plcsim.recorder.bag.reading import open_bag

from .conftest import make_project, running

PAGES = ("system", "classes", "variables", "trace", "source", "logbook", "network")


@pytest.fixture(scope="module")
def press(tmp_path_factory):
    with running(make_project(tmp_path_factory.mktemp("press"))) as made:
        yield made


@pytest.fixture(scope="module")
def guarded(tmp_path_factory):
    folder = make_project(tmp_path_factory.mktemp("guarded"))
    users = Users(users_file(folder))
    users.add("anna", Role.ENGINEER, "correct horse")
    users.add("otto", Role.LOOK, "battery staple")
    with running(folder) as made:
        yield made


def read(press, *tags):
    body = json.dumps({"tags": tags}).encode()
    asked = urllib.request.Request(
        f"{press.url}/api/read", body, {"Content-Type": "application/json"}
    )
    with urllib.request.urlopen(asked, timeout=100) as answer:
        return json.load(answer)["values"]


def audit(press):
    lines = (press.folder / ".plcsim" / "web-audit.jsonl").read_text().splitlines()
    return [json.loads(line) for line in lines]


def open_page(page, press, name):
    page.goto(f"{press.url}/#{name}")
    page.locator("h1").wait_for()


def unfold(page, path):
    row = page.locator(f'tr[data-path="{path}"]')
    if row.locator(".twist").get_attribute("aria-expanded") == "false":
        row.locator(".twist").click()


def eventually(page, act):
    """Wait until something holds; a value takes a cycle, a snapshot and a message."""
    for _ in range(1000):
        if act():
            return
        page.wait_for_timeout(50)
    assert act()


def test_a_variable_is_watched_written_forced_and_released(page, press):
    open_page(page, press, "variables")
    unfold(page, "line")
    shown = page.get_by_role("button", name="Value of line.setpoint", exact=True)
    eventually(page, lambda: re.fullmatch(r"[\d.]+", shown.inner_text()))
    counted = page.get_by_role("button", name="Value of line.parts", exact=True)
    first = counted.inner_text()
    eventually(page, lambda: counted.inner_text() != first)

    shown.click()
    page.get_by_label("New value").fill("2.25")
    page.get_by_label("New value").press("Enter")
    eventually(page, lambda: read(press, "line.setpoint_seen") == [2.25])
    eventually(page, lambda: shown.inner_text() == "2.25")

    shown.click()
    page.get_by_label("New value").fill("7.5")
    page.get_by_role("button", name="Force", exact=True).click()
    page.get_by_text("Forced to 7.5 by web: local").wait_for()
    page.keyboard.press("Escape")
    row = page.locator('tr[data-path="line.setpoint"]')
    assert "forced-row" in row.get_attribute("class")
    assert read(press, "line.setpoint_seen") == [7.5]
    page.get_by_role("button", name="1 forced").click()
    page.get_by_role("button", name="Release", exact=True).click()
    eventually(page, lambda: "forced-row" not in (row.get_attribute("class") or ""))
    assert page.get_by_role("button", name="1 forced").count() == 0

    acts = [(line["act"], line["tag"], line["who"]) for line in audit(press)[-3:]]
    assert acts == [(a, "line.setpoint", "local") for a in ("write", "force", "release")]


def test_a_wrong_value_is_told_and_changes_nothing(page, press):
    open_page(page, press, "variables")
    unfold(page, "drive")
    page.get_by_role("button", name="Value of drive.position", exact=True).click()
    page.get_by_label("New value").fill("much")
    page.get_by_role("button", name="Write").click()
    page.get_by_role("alert").get_by_text("drive.position:").wait_for()


def test_lists_and_formats_stay_in_the_browser(page, press):
    open_page(page, press, "variables")
    page.get_by_label("Search variables").fill("drive pos")
    page.get_by_label("Keep drive.position in a list").click()
    page.get_by_role("button", name="Value of drive.position", exact=True).click()
    page.get_by_label("Shown as").select_option("hex")
    page.keyboard.press("Escape")
    page.get_by_label("What is shown").select_option("Watch")
    page.reload()
    shown = page.get_by_role("button", name="Value of drive.position", exact=True)
    eventually(page, lambda: re.fullmatch("16#[0-9A-F]{4}", shown.inner_text()))


def test_names_and_values_are_text(page, press):
    open_page(page, press, "variables")
    assert page.locator("#project").inner_text() == "<b>press</b>"
    unfold(page, "drive")
    shown = page.get_by_role("button", name="Value of drive.name", exact=True)
    eventually(page, lambda: shown.inner_text() == "'<img src=x onerror=document.title=1>'")
    assert page.locator("img:not([src='icon.svg'])").count() == 0
    assert page.title() != "1"


def trace(page, press, *tags):
    open_page(page, press, "trace")
    for tag in tags:
        field = page.get_by_label("Add a variable")
        field.fill(tag)
        field.press("Enter")
        page.get_by_role("button", name=f"Remove {tag}").wait_for()


def samples(text):
    """Return how many samples a trace has, as it says."""
    found = re.match(r"([\d\s]+) samples", text)
    return int(re.sub(r"\s", "", found[1])) if found else 0


def exported(page):
    """Return the rows of the trace as CSV."""
    with page.expect_download() as download:
        page.get_by_role("button", name="CSV").click()
    lines = Path(download.value.path()).read_text().splitlines()
    return lines[0].split(","), [[float(cell) for cell in line.split(",")] for line in lines[1:]]


def test_a_trace_has_every_cycle(page, press, tmp_path):
    trace(page, press, "drive.count", "drive.wave", "drive.is_high")
    page.get_by_role("button", name="Start", exact=True).click()
    status = page.get_by_role("main").get_by_role("status")
    eventually(page, lambda: samples(status.inner_text()) > 800)
    page.get_by_role("button", name="Stop", exact=True).click()
    names, rows = exported(page)
    assert names == ["time_s", "cycle", "drive.count", "drive.wave", "drive.is_high"]
    cycles = [row[1] for row in rows]
    assert cycles == [cycles[0] + at for at in range(len(cycles))]
    counts = [row[2] for row in rows]
    assert counts == [counts[0] + at for at in range(len(counts))]
    assert ", 0 lost" in status.inner_text()
    with page.expect_download() as download:
        page.get_by_role("button", name="PNG").click()
    assert Path(download.value.path()).read_bytes().startswith(b"\x89PNG")
    with page.expect_download() as download:
        page.get_by_role("button", name="Bag").click()
    with open_bag(Path(download.value.path()).rename(tmp_path / "trace.bag")) as bag:
        found = [m.data for m in bag.messages(["/plcsim/cycle"])]
    assert [int.from_bytes(data, "little") for data in found][: len(cycles)] == cycles


def test_a_trigger_stops_a_trace_where_it_is_told(page, press):
    trace(page, press, "drive.wave", "drive.is_high")
    page.get_by_label("Window").select_option("1")
    page.get_by_label("Stop", exact=True).select_option("single")
    page.get_by_label("Variable", exact=True).select_option("drive.is_high")
    page.get_by_label("Level").fill("0.5")
    page.get_by_label("Edge").select_option("falling")
    page.get_by_label("Before, %").fill("40")
    page.get_by_role("button", name="Start", exact=True).click()
    page.get_by_text("triggered at").wait_for()
    page.get_by_role("button", name="Start", exact=True).wait_for()
    status = page.get_by_role("main").get_by_role("status").inner_text()
    time_s = float(re.search(r"triggered at ([\d.]+) s", status)[1])
    _, rows = exported(page)
    at = next(i for i, row in enumerate(rows) if abs(row[0] - time_s) < 0.0006)
    assert (rows[at - 1][3], rows[at][3]) == (1, 0)
    assert rows[-1][0] >= time_s + 0.6
    assert page.locator(".u-over").count() == 2


def test_pause_single_cycles_and_on(page, press):
    open_page(page, press, "system")
    page.get_by_role("button", name="Pause").click()
    page.locator("#state", has_text="PAUSED").wait_for()
    before = read(press, "drive.count")[0]
    page.get_by_role("button", name="Single cycle").click()
    eventually(page, lambda: read(press, "drive.count")[0] == before + 1)
    page.get_by_role("button", name="Continue").click()
    page.locator("#state", has_text="RUN").wait_for()
    eventually(page, lambda: read(press, "drive.count")[0] > before + 5)


def control(page, act):
    page.get_by_role("button", name="Control …").click()
    page.get_by_role("button", name=act, exact=True).click()
    page.get_by_role("dialog", name=act, exact=True).get_by_role("button", name=act).click()


def test_the_controller_is_stopped_and_started_and_its_logbook_tells(page, press):
    open_page(page, press, "logbook")
    control(page, "Stop")
    page.locator("#state", has_text="STOPPED").wait_for()
    before = read(press, "drive.count")
    page.wait_for_timeout(300)
    assert read(press, "drive.count") == before
    control(page, "Warm start")
    page.locator("#state", has_text="RUN").wait_for()
    page.get_by_role("cell", name="warm restart", exact=True).first.wait_for()
    page.get_by_label("Filter the logbook").fill("stopped")
    eventually(page, lambda: page.locator(".logbook tbody tr").count() == 1)
    assert "STOPPED: somebody asked to stop" in page.locator(".logbook tbody").inner_text()
    with page.expect_download() as download:
        page.get_by_role("button", name="Download").click()
    assert "STOPPED" in Path(download.value.path()).read_text()
    assert [line["act"] for line in audit(press)[-2:]] == ["stop", "warm_restart"]


def test_a_fault_is_seen_and_left_by_a_start(page, press):
    open_page(page, press, "variables")
    unfold(page, "drive")
    page.get_by_role("button", name="Value of drive.fail", exact=True).click()
    page.get_by_label("New value").select_option("TRUE")
    page.get_by_role("button", name="Write").click()
    page.locator("#state", has_text="SERVICE").wait_for()
    page.goto(f"{press.url}/#logbook")
    page.get_by_text("division by zero").first.wait_for()
    control(page, "Cold start")
    page.locator("#state", has_text="RUN").wait_for()


def test_task_classes_show_histograms_and_the_last_cycles(page, press):
    open_page(page, press, "classes")
    page.get_by_role("img", name=re.compile("^Lateness: median")).first.wait_for()
    eventually(page, lambda: page.locator(".gantt rect.run.c1").count() > 3)
    page.get_by_role("heading", name="Task class #4").wait_for()


def test_source_shows_values_beside_the_lines(page, press):
    open_page(page, press, "source")
    page.get_by_label("File").select_option(label="drive/Main.st")
    line = page.locator(".source tr", has_text="wave := SIN(phase)")
    chip = line.get_by_role("button", name=re.compile(r"^wave -?[\d.e-]+$"))
    chip.wait_for()
    first = chip.inner_text()
    eventually(page, lambda: chip.inner_text() != first)
    assert page.locator(".source .hl-keyword", has_text="END_IF").count() == 2
    assert page.locator(".source .hl-text").inner_text().startswith("'<img src=x")


def test_a_pointer_is_followed_and_followed_anew_when_it_changes(page, press):
    open_page(page, press, "variables")
    unfold(page, "drive")
    unfold(page, "drive.nearest")
    shown = page.get_by_role("button", name="Value of drive.nearest^.target", exact=True)
    eventually(page, lambda: shown.inner_text() == "11.0")
    page.get_by_role("button", name="Value of drive.chosen", exact=True).click()
    page.get_by_label("New value").fill("3")
    page.get_by_role("button", name="Write").click()
    eventually(page, lambda: shown.inner_text() == "33.0")
    page.get_by_role("button", name="Value of drive.nowhere", exact=True).wait_for()
    unfold(page, "drive.nowhere")
    page.get_by_text("drive.nowhere points to nothing: it is 0").wait_for()


def test_network_lists_this_browser(page, press):
    open_page(page, press, "network")
    port = press.url.rpartition(":")[2]
    page.get_by_role("cell", name=f"127.0.0.1:{port}").or_(
        page.get_by_role("cell", name=f"[::1]:{port}")
    ).first.wait_for()
    page.get_by_text(re.compile(r"web · \d+ connected")).wait_for()
    told = page.get_by_role("region", name="Sockets of web")
    eventually(page, lambda: re.search(r"[1-9]\d*(\.\d)? (B|KiB)/s", told.inner_text()))


def log_in(page, guarded, name, password):
    page.goto(guarded.url)
    page.get_by_label("Name").fill(name)
    page.get_by_label("Password").fill(password)
    page.get_by_label("Password").press("Enter")


def test_a_wrong_password_does_not_get_in(page, guarded):
    log_in(page, guarded, "anna", "wrong horse")
    page.get_by_text("name or password is wrong").wait_for()
    assert page.locator("#project").inner_text() == "plcsim"
    page.get_by_label("Password").fill("correct horse")
    page.get_by_label("Password").press("Enter")
    page.get_by_text("anna · engineer").wait_for()
    page.get_by_role("button", name="Log out").click()
    page.get_by_role("dialog", name="Log in").wait_for()


def test_who_only_looks_has_nothing_to_press(page, guarded):
    log_in(page, guarded, "otto", "battery staple")
    page.get_by_text("otto · look").wait_for()
    assert page.get_by_role("button", name="Control …").is_disabled()
    page.goto(f"{guarded.url}/#variables")
    unfold(page, "line")
    page.get_by_role("button", name="Value of line.setpoint", exact=True).click()
    for name in ("Write", "Force"):
        assert page.get_by_role("button", name=name, exact=True).is_disabled()
    answer = page.evaluate(
        """async () => (await fetch("api/write", {method: "POST",
        headers: {"Content-Type": "application/json"},
        body: JSON.stringify({tag: "line.setpoint", value: "9.0"})})).status"""
    )
    assert answer == 403
    page.faults.clear()  # the browser tells that refusal as an error


@pytest.mark.parametrize("mode", ["light", "dark", "narrow"])
def test_pages_are_accessible(browser, press, axe, mode):
    size = {"width": 390, "height": 844} if mode == "narrow" else {"width": 1200, "height": 900}
    scheme = "dark" if mode == "dark" else "light"
    context = browser.new_context(viewport=size, color_scheme=scheme)
    page = context.new_page()
    found = []
    for name in PAGES:
        open_page(page, press, name)
        page.wait_for_timeout(700)
        page.evaluate(axe)
        result = page.evaluate("axe.run(document, {resultTypes: ['violations']})")
        found += [
            f"{name}: {v['id']}: {[n['html'][:90] for n in v['nodes'][:2]]}"
            for v in result["violations"]
        ]
        width = page.evaluate("document.documentElement.scrollWidth")
        assert width <= size["width"], f"{name} is wider than the screen"
        link = page.locator("#nav a[aria-current]").bounding_box()
        assert link is not None
        assert link["x"] >= 0, name
        assert link["x"] + link["width"] <= size["width"], name
    context.close()
    assert not found


def test_everything_is_reached_by_keys(page, press):
    open_page(page, press, "variables")
    unfold(page, "line")
    page.get_by_role("button", name="Value of line.setpoint", exact=True).focus()
    page.keyboard.press("Enter")
    page.get_by_label("New value").wait_for()
    eventually(page, lambda: page.evaluate("document.activeElement.id") == "new-value")
    page.keyboard.press("Control+a")
    page.keyboard.type("3.75")
    page.keyboard.press("Tab")
    page.wait_for_timeout(300)  # nothing that the dialog does later takes the focus away
    assert page.evaluate("document.activeElement.textContent") == "Write"
    page.keyboard.press("Enter")
    eventually(page, lambda: read(press, "line.setpoint") == [3.75])
    eventually(page, lambda: page.get_by_role("dialog").count() == 0)
    assert page.evaluate("document.activeElement.getAttribute('aria-label')") == (
        "Value of line.setpoint"
    )
