"""A project as a user runs it with --web, and Chromium to look at its pages."""

import re
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

HERE = Path(__file__).parent
CHROMIUM = Path("/usr/bin/chromium")
AXE = HERE / "peers" / "node_modules" / "axe-core" / "axe.min.js"
TIMEOUT_S = 100.0
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]

FILES = {
    "plc.toml": """
        [plc]
        name = "<b>press</b>"
        realtime = "off"

        [task_class.1]
        cycle = "2ms"
        tolerance = "10s"
        programs = ["drive"]

        [task_class.4]
        cycle = "50ms"
        tolerance = "10s"
        programs = ["line"]

        [web]
        port = 0
    """,
    "drive/Main.st": """
        PROGRAM _INIT
            name := '<img src=x onerror=document.title=1>';
            mode := AUTO;
            chosen := 1;
            FOR at := 1 TO 3 DO
                axes[at].target := 11.0 * at;
            END_FOR;
        END_PROGRAM

        PROGRAM _CYCLIC
            count := count + 1;
            phase := phase + 0.02;
            IF phase > 6.283185 THEN
                phase := phase - 6.283185;
            END_IF;
            wave := SIN(phase);
            is_high := wave > 0.5;
            nearest ACCESS ADR(axes[chosen]);
            position := REAL_TO_INT(wave * 1000.0);
            IF fail THEN
                count := count / zero;
            END_IF;
        END_PROGRAM
    """,
    "drive/Variables.var": """
        VAR
            count : UDINT;
            zero : UDINT;
            phase : REAL;
            wave : REAL;
            is_high : BOOL;
            fail : BOOL;
            position : INT;
            name : STRING[60];
            mode : Mode;
            axes : ARRAY[1..3] OF Axis;
            at : INT;
            chosen : INT;
            nearest : REFERENCE TO Axis;
            nowhere : REFERENCE TO Axis;
        END_VAR
    """,
    "Global.typ": """
        TYPE
            Mode : (OFF, AUTO, MANUAL);
            Axis : STRUCT
                target : REAL;
                enabled : BOOL;
            END_STRUCT;
        END_TYPE
    """,
    "line/Main.st": """
        PROGRAM _CYCLIC
            setpoint_seen := setpoint;
            parts := parts + 1;
        END_PROGRAM
    """,
    "line/Variables.var": """
        VAR
            setpoint : REAL := 1.5;
            setpoint_seen : REAL;
            parts : UDINT;
            pause : TIME := T#1s500ms;
        END_VAR
    """,
}


def make_project(folder: Path) -> Path:
    for name, text in FILES.items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(textwrap.dedent(text))
    return folder


class Running:
    """A project under ``plcsim run --web``."""

    def __init__(self, folder: Path, *options: str) -> None:
        self.folder = folder
        command = [sys.executable, "-m", "plcsim", "run", "--web", str(folder), *options]
        self._process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, bufsize=1)
        try:
            self.url = self._wait()
        except BaseException:
            self._process.kill()
            self._process.communicate()
            raise

    def _wait(self) -> str:
        """Wait until the pages are served; return their address."""
        assert self._process.stderr is not None
        deadline = time.monotonic() + TIMEOUT_S
        told = []
        while time.monotonic() < deadline:
            line = self._process.stderr.readline()
            told.append(line)
            found = re.search(r"web: (http://\S+)", line)
            if found:
                return found[1].replace("127.0.0.1", "localhost")
        raise AssertionError(f"no pages: {''.join(told)}")

    def stop(self) -> int:
        self._process.send_signal(signal.SIGINT)
        self._process.communicate(timeout=TIMEOUT_S)
        return self._process.returncode


@contextmanager
def running(folder: Path, *options: str) -> Iterator[Running]:
    made = Running(folder, *options)
    try:
        yield made
    finally:
        made.stop()


@pytest.fixture(scope="module")  # playwright's loop runs as long; nobody else has one meanwhile
def browser() -> Iterator[Any]:
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if not CHROMIUM.exists():
        pytest.skip("Chromium is not installed")
    with playwright.sync_playwright() as driver:
        made = driver.chromium.launch(executable_path=str(CHROMIUM), args=FLAGS)
        yield made
        made.close()


@pytest.fixture(scope="session")
def axe() -> str:
    if not AXE.exists():
        pytest.skip("axe-core is not installed")
    return AXE.read_text()


@pytest.fixture
def page(browser: Any) -> Iterator[Any]:
    """A page whose scripts must not fail."""
    context = browser.new_context(viewport={"width": 1200, "height": 900})
    made = context.new_page()
    faults: list[str] = []
    made.on("pageerror", lambda error: faults.append(error.stack or str(error)))
    made.on("console", lambda told: faults.append(told.text) if told.type == "error" else None)
    made.set_default_timeout(TIMEOUT_S * 1000)
    made.faults = faults
    yield made
    context.close()
    assert not [f for f in faults if "401" not in f and "429" not in f and "WebSocket" not in f]
