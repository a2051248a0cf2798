"""Manual: takes the pictures of the pages for docs/images, from the project of the tests here.

``python3 tests/interop/web/pictures.py FOLDER [MODE...]`` with modes light, dark, narrow.
"""

import shutil
import socket
import sys
import tempfile
import threading
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

sys.path.insert(0, str(Path(__file__).parents[3]))
from tests.interop.web.conftest import CHROMIUM, FLAGS, make_project, running

ROOT = Path(__file__).parents[3]
MODBUS_PORT, SERVER_PORT = 15502, 22011
SIZES = {"light": (1200, 800), "dark": (1200, 800), "narrow": (390, 844)}


def _system(page: Page) -> None:
    page.locator("h1").wait_for()


def _variables(page: Page) -> None:
    page.locator(".twist").first.wait_for()
    for path in ("drive", "line"):
        row = page.locator(f'tr[data-path="{path}"] .twist')
        if row.get_attribute("aria-expanded") == "false":
            row.click()
            page.wait_for_timeout(400)
    for path, value in (("line.setpoint", "7.5"),):
        page.get_by_role("button", name=f"Value of {path}", exact=True).click()
        page.get_by_label("New value").fill(value)
        page.get_by_role("button", name="Force", exact=True).click()
        page.wait_for_timeout(400)
        page.keyboard.press("Escape")
    page.evaluate("scrollTo(0, 0)")


def _trace(page: Page) -> None:
    for tag in ("drive.wave", "drive.is_high", "drive.position"):
        if page.get_by_role("button", name=f"Remove {tag}").count():
            continue
        field = page.get_by_label("Add a variable")
        field.fill(tag)
        field.press("Enter")
        page.wait_for_timeout(700)
    page.get_by_label("Window").select_option("5")
    page.get_by_role("button", name="Start", exact=True).click()
    page.wait_for_timeout(6000)
    box = page.locator(".u-over").first.bounding_box()
    assert box is not None
    for key, share in (("a", 0.6), ("b", 0.85)):
        page.mouse.move(box["x"] + box["width"] * share, box["y"] + 10)
        page.wait_for_timeout(200)
        page.keyboard.press(key)


def _network(page: Page) -> None:
    page.get_by_text("TcpServer").or_(page.get_by_text("TcpRecv")).first.wait_for()
    page.locator('td:has-text("B/s")').first.wait_for()


def _source(page: Page) -> None:
    page.get_by_label("File").select_option(label="drive/Main.st")


STEPS = {
    "system": _system, "classes": _system, "variables": _variables, "trace": _trace,
    "source": _source, "logbook": _system, "network": _network,
}  # fmt: skip


def _project(folder: Path) -> Path:
    """Return the project of the tests with rights, without what is there to be hostile."""
    file = make_project(folder) / "plc.toml"
    text = file.read_text().replace('realtime = "off"', 'realtime = "auto"')
    file.write_text(text.replace("<b>press</b>", "press"))
    source = folder / "drive" / "Main.st"
    source.write_text(source.read_text().replace("<img src=x onerror=document.title=1>", "left"))
    shutil.copytree(ROOT / "programs" / "tcp_server_st" / "thesis_server", folder / "server")
    told = file.read_text().replace('programs = ["line"]', 'programs = ["line", "server"]')
    file.write_text(f"{told}\n[modbus]\nport = {MODBUS_PORT}\n")
    (folder / "tags.csv").write_text("tag,area,offset\ndrive.position,hr,0\nline.parts,hr,1\n")
    return folder


def _poll(ended: threading.Event) -> None:
    """Be an HMI that reads over Modbus, and a client of the program's server."""
    with (
        socket.create_connection(("127.0.0.1", MODBUS_PORT)) as hmi,
        socket.create_connection(("127.0.0.1", SERVER_PORT)),
    ):
        while not ended.wait(0.1):
            hmi.sendall(bytes.fromhex("0001 0000 0006 01 03 0000 0003"))
            hmi.recv(100)


def main() -> None:
    """Take all pictures."""
    folder, *modes = sys.argv[1:]
    ended = threading.Event()
    polling = threading.Thread(target=_poll, args=(ended,))
    with (
        tempfile.TemporaryDirectory() as place,
        running(_project(Path(place) / "press")) as press,
        sync_playwright() as driver,
    ):
        polling.start()
        browser = driver.chromium.launch(executable_path=str(CHROMIUM), args=FLAGS)
        for mode in modes or SIZES:
            width, height = SIZES[mode]
            scheme = "dark" if mode == "dark" else "light"
            context = browser.new_context(
                viewport={"width": width, "height": height}, color_scheme=scheme
            )
            page = context.new_page()
            for name, step in STEPS.items():
                page.goto(f"{press.url}/#{name}")
                step(page)
                page.wait_for_timeout(1500)
                page.screenshot(path=f"{folder}/web-{name}-{mode}.png")
            context.close()
        ended.set()
        polling.join()


if __name__ == "__main__":
    main()
