"""What a newcomer adds: a block library by one folder, a service by one folder and one entry point.

Both are made in a temporary folder, with nothing else touched, and used by a project.
"""

import json
import os
import signal
import subprocess
import sys
import textwrap
import time

import pytest

PATIENCE_S = 120

SERVICE = {
    "beacon/__init__.py": "",
    "beacon/extension.py": """
        from typing import Annotated

        from plcsim.project.extension import Attachment, Extension
        from plcsim.settings import Whole, settings


        @settings
        class BeaconSettings:
            tag: str
            most: Annotated[int, Whole(1, 100)] = 10


        class Beacon(Extension):
            def read(self, table):
                return table.read(BeaconSettings)

            def service(self, settings):
                return "beacon.service"

            def attach(self, settings, controller):
                tag = controller.tags.find(settings.tag)
                return Attachment({"tag": tag.path}, [tag])


        EXTENSION = Beacon()
    """,
    "beacon/service.py": """
        import time
        from pathlib import Path

        def serve(service):
            image, path = service.image, service.given["tag"]
            tag = image.directory.find(path)
            at = image.directory.offset_of(tag.address, 4)
            service.serving(f"shows {path}")
            while not service.is_stopping:
                number = int.from_bytes(image.copy(at, at + 4)[1], "little")
                Path("seen.txt").write_text(str(number))
                time.sleep(0.01)
    """,
    "beacon-1.dist-info/METADATA": "Metadata-Version: 2.1\nName: beacon\nVersion: 1\n",
    "beacon-1.dist-info/entry_points.txt": """
        [plcsim.extensions]
        beacon = beacon.extension:EXTENSION

        [plcsim.libraries]
        lamps = lamps
    """,
    "lamps/lamps.fun": """
        FUNCTION_BLOCK Lamp
            VAR_INPUT
                On : BOOL;
            END_VAR
            VAR_OUTPUT
                Changes : UDINT;
            END_VAR
            VAR
                edge : R_TRIG;
            END_VAR
        END_FUNCTION_BLOCK
    """,
    "lamps/__init__.py": "",
    "lamps/lamp.py": """
        from lamps import interface

        class Lamp(interface.Lamp):
            def execute(self):
                self.edge(CLK=self.On)
                self.Changes += self.edge.Q
    """,
}

PROJECT = {
    "plc.toml": """
        [libraries]
        folders = ["../outside/ramps"]

        [task_class.1]
        cycle = "10ms"
        programs = ["main"]

        [beacon]
        tag = "main.ramp.Out"
    """,
    "main/Variables.var": "VAR ramp : Ramp; lamp : Lamp; END_VAR\n",
    "main/main.py": """
        from plcsim import Program
        from ..ramps import Ramp

        class Main(Program):
            def cyclic(self):
                self.ramp(Step=2)
                self.lamp(On=not self.lamp.On)
    """,
}

RAMPS = {
    "ramps/ramps.fun": """
        FUNCTION_BLOCK Ramp
            VAR_INPUT
                Step : UDINT;
            END_VAR
            VAR_OUTPUT
                Out : UDINT;
                axis : RampAxis;
            END_VAR
        END_FUNCTION_BLOCK
    """,
    "ramps/ramps.typ": "TYPE RampAxis : STRUCT speed : REAL; END_STRUCT; END_TYPE\n",
    "ramps/ramp.py": """
        from . import interface

        class Ramp(interface.Ramp):
            def execute(self):
                self.Out += self.Step
                self.axis.speed = self.Out / 2
    """,
}


@pytest.fixture
def place(tmp_path):
    """A folder with a project, a library outside it, and the site of an installed package."""
    for folder, files in (("site", SERVICE), ("my_plc", PROJECT), ("outside", RAMPS)):
        for name, text in files.items():
            file = tmp_path / folder / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(textwrap.dedent(text))
    return tmp_path


def environment(place):
    """Return where the package is installed; only a process of its own sees that."""
    paths = [str(place / "site"), os.environ.get("PYTHONPATH", "")]
    return os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, paths))}


def number_in(file):
    """Return what the service has written so far."""
    try:
        return int(file.read_text() or 0)
    except FileNotFoundError:
        return 0


def python(place, *arguments):
    """Run Python there."""
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=place,
        env=environment(place),
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )


def plcsim(place, *arguments):
    """Run plcsim there."""
    return python(place, "-m", "plcsim", *arguments)


def test_libraries_and_a_service_of_ones_own(place):
    """A library by one line of plc.toml, one by an entry point, a service by another."""
    checked = plcsim(place, "check", "my_plc")
    assert (checked.returncode, checked.stderr) == (0, "")
    report, seen = place / "report.json", place / "seen.txt"
    run = subprocess.Popen(
        [sys.executable, "-m", "plcsim", "run", "my_plc", "--report", str(report)],
        cwd=place,
        env=environment(place),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        deadline = time.monotonic() + PATIENCE_S
        while not number_in(seen) and run.poll() is None and time.monotonic() < deadline:
            time.sleep(0.02)
        run.send_signal(signal.SIGINT)
        printed, _ = run.communicate(timeout=PATIENCE_S)
    finally:
        run.kill()
    assert "beacon: shows main.ramp.Out" in printed
    assert json.loads(report.read_text())["state"] == "STOPPED"
    assert number_in(seen) >= 2


def test_what_is_wrong_in_them_is_told_by_file_and_line(place):
    ramp = place / "outside" / "ramps" / "ramp.py"
    ramp.write_text(ramp.read_text().replace("self.Step", "self.Stp"))
    (place / "my_plc" / "plc.toml").write_text(
        textwrap.dedent(PROJECT["plc.toml"]).replace("tag =", "tga =")
    )
    checked = plcsim(place, "check", "my_plc")
    assert checked.returncode == 1
    assert "plc.toml: beacon.tga: unknown key; did you mean tag?" in checked.stderr
    (place / "my_plc" / "plc.toml").write_text(textwrap.dedent(PROJECT["plc.toml"]))
    checked = plcsim(place, "check", "my_plc")
    assert f"{ramp}:6: Ramp has no Stp; did you mean Step?" in checked.stderr


def test_the_block_of_an_entry_point_runs_in_virtual_time(place):
    script = """
        from pathlib import Path
        from plcsim.testing.target import open_plc
        with open_plc(Path("my_plc")) as plc:
            plc.cycles(10)
            print(plc["main.lamp.Changes"], plc["main.ramp.Out"], plc["main.ramp.axis.speed"])
    """
    (place / "script.py").write_text(textwrap.dedent(script))
    shown = python(place, "script.py")
    assert (shown.stdout, shown.stderr) == ("5 20 10.0\n", "")
