"""Manual: FUXA shows and drives programs/tank; started by fuxa.sh.

Gives FUXA the device that ``plcsim tags export --format fuxa`` prints and a view with the level,
the valve, the pump and the alarms; starts the pump and moves the setpoint through FUXA's own
interface; takes a screenshot of the view with headless Chromium.
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.parse
import urllib.request
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[3]))
from tests.interop.modbus.conftest import TANK, Running
from tests.ports import free_port

VALUES = (
    ("control_level", "level", "m"),
    ("control_setpoint", "setpoint", "m"),
    ("control_pump_speed", "pump speed", "%"),
    ("control_litres", "pumped", "l"),
    ("control_level_ir3", "level, low word first", "m"),
)
LAMPS = (
    ("valve_open", "inlet valve"),
    ("pump_on", "pump"),
    ("control_alarm_high", "high alarm"),
    ("control_alarm_low", "low alarm"),
)
TEXT = 'font-family="sans-serif" font-size="16" fill="#000000" stroke-width="0"'


def item(identity: str, kind: str, tag: str, ranges: list[dict[str, Any]]) -> dict[str, Any]:
    properties = {"events": [], "variableId": tag, "ranges": ranges}
    return {"id": identity, "type": kind, "name": identity, "property": properties, "label": kind}


def view(tags: dict[str, str]) -> dict[str, Any]:
    """Return a view; ``tags`` gives FUXA's id of a tag by its name."""
    items: dict[str, Any] = {}
    parts = [f'<text x="40" y="50" {TEXT} font-weight="bold">plcsim: programs/tank</text>']
    bar = "GXP_level"
    items[bar] = item(
        bar, "svg-ext-gauge_progress", tags["control_level"],
        [{"type": "minmax", "min": 0, "max": 10, "style": [True, True], "color": "#4f8fd9"}],
    )  # fmt: skip
    parts.append(
        f'<g id="{bar}" type="svg-ext-gauge_progress" font-size="14" stroke="null">'
        '<rect id="A-GXP_level" fill="#dededeff" x="60" y="90" width="120" height="280"/>'
        '<rect id="B-GXP_level" fill="#4f8fd9" x="60" y="230" width="120" height="140"/>'
        '<foreignObject id="H-GXP_level" x="60" y="90" width="120" height="280"/></g>'
    )
    for row, (name, label, unit) in enumerate(VALUES):
        identity, y = f"VAL_{name}", 110 + 44 * row
        unit_range = {"type": "unit", "min": 2, "max": 2, "text": f" {unit}"}
        items[identity] = item(identity, "svg-ext-value", tags[name], [unit_range])
        parts.append(
            f'<text x="230" y="{y}" {TEXT}>{label}</text><g id="{identity}" type="svg-ext-value">'
            f'<text id="T{identity}" x="430" y="{y}" {TEXT}>##.##</text></g>'
        )
    for row, (name, label) in enumerate(LAMPS):
        identity, y = f"GSE_{name}", 110 + 44 * row
        colours = [("0", "#c8c8c8"), ("1", "#d03030" if "alarm" in name else "#30a040")]
        ranges = [{"type": "range", "min": v, "max": v, "color": c} for v, c in colours]
        items[identity] = item(identity, "svg-ext-gauge_semaphore", tags[name], ranges)
        parts.append(
            f'<g id="{identity}" type="svg-ext-gauge_semaphore">'
            f'<ellipse id="E{identity}" cx="580" cy="{y - 5}" rx="13" ry="13" fill="#ffffff"'
            f' stroke="#333333"/></g><text x="610" y="{y}" {TEXT}>{label}</text>'
        )
    svg = (
        '<svg width="800" height="420" xmlns="http://www.w3.org/2000/svg"><g>'
        f"<title>Layer 1</title>{''.join(parts)}</g></svg>"
    )
    profile = {"width": 800, "height": 420, "bkcolor": "#ffffffff"}
    return {"id": "v_tank", "name": "tank", "profile": profile, "items": items,
            "variables": {}, "svgcontent": svg}  # fmt: skip


def project(folder: Path) -> tuple[dict[str, Any], dict[str, str]]:
    """Return the project for FUXA, and the id of each tag by its name."""
    exported = subprocess.run(
        [sys.executable, "-m", "plcsim.cli.main", "tags", "export", str(folder), "--format",
         "fuxa"],
        check=True, capture_output=True, text=True,
    ).stdout  # fmt: skip
    devices = json.loads(exported)
    (device,) = devices.values()
    tags = {tag["name"]: tag["id"] for tag in device["tags"].values()}
    layout = {"start": "v_tank", "navigation": {"mode": "void", "type": "block", "items": []},
              "header": {}}  # fmt: skip
    return {
        "version": "1.00",
        "name": "tank",
        "devices": devices,
        "hmi": {"views": [view(tags)], "layout": layout},
        "server": {"id": "0", "name": "FUXA Server", "type": "FuxaServer", "property": {}},
    }, tags


class Fuxa:
    """FUXA on a port of its own, spoken to by its REST interface."""

    def __init__(self, package: Path, work: Path) -> None:
        self.url = f"http://127.0.0.1:{(port := free_port())}"
        self.process = subprocess.Popen(
            ["node", str(package / "main.js"), "--port", str(port), "--userDir", str(work)],
            cwd=work, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        self.until(lambda: self.ask("/api/version") is not None)

    def ask(self, path: str, body: object = None) -> Any:
        data = None if body is None else json.dumps(body).encode()
        headers = {"Content-Type": "application/json"}
        request = urllib.request.Request(self.url + path, data, headers)
        try:
            with urllib.request.urlopen(request, timeout=10) as answer:
                text = answer.read()
        except OSError:
            return None
        try:
            return json.loads(text) if text else {}
        except ValueError:
            return {}

    def value(self, tag: str) -> float | None:
        ids = urllib.parse.quote(json.dumps([tag]))
        found = self.ask(f"/api/getTagValue?ids={ids}")
        return found[0]["value"] if found and found[0]["value"] is not None else None

    def set(self, tag: str, value: object) -> None:
        self.ask("/api/setTagValue", {"tags": [{"id": tag, "value": value}]})

    @staticmethod
    def until(condition: Any, seconds: float = 60) -> None:
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                raise SystemExit("FUXA does not do what it should")
            time.sleep(0.3)


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--fuxa", type=Path, required=True)
    parser.add_argument("--screenshot", type=Path, required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "tank"
        shutil.copytree(TANK, folder, ignore=shutil.ignore_patterns("__pycache__", ".*"))
        tank = Running(folder)
        work = Path(name) / "fuxa"
        work.mkdir()
        fuxa = Fuxa(options.fuxa, work)
        try:
            drive(fuxa, folder, options.screenshot.resolve())
        finally:
            fuxa.process.terminate()
            fuxa.process.wait()
            tank.stop()
    return 0


def drive(fuxa: Fuxa, folder: Path, screenshot: Path) -> None:
    made, tags = project(folder)
    if fuxa.ask("/api/project", made) is None:
        raise SystemExit("FUXA refuses the project")
    fuxa.until(lambda: fuxa.value(tags["control_level"]) is not None)
    print(f"level {fuxa.value(tags['control_level']):.2f} m")
    fuxa.set(tags["control_setpoint"], 5.5)
    fuxa.set(tags["control_pump_speed"], 45)
    fuxa.set(tags["control_pump_request"], True)
    fuxa.until(lambda: fuxa.value(tags["control_setpoint"]) == 5.5)
    fuxa.until(lambda: fuxa.value(tags["control_pump_speed"]) == 45)
    fuxa.until(lambda: fuxa.value(tags["pump_on"]) in (True, 1))
    print("setpoint, pump speed and pump written and read back")
    subprocess.run(
        ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
         "--window-size=820,440", "--virtual-time-budget=8000", "--timeout=9000",
         f"--screenshot={screenshot}", f"{fuxa.url}/home"],
        check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=90,
    )  # fmt: skip
    print(f"screenshot {screenshot}")


if __name__ == "__main__":
    sys.exit(main())
