"""Projects of one program, and plcsim as a process of its own that runs them."""

import os
import subprocess
import sys

import pytest

HEAD = "import ctypes, os, signal, sys, threading, time\nfrom plcsim import Program\n"
QUICK = 'watchdog = "100ms"\nrealtime = "off"\n'  # other tests may need the processor
SLOW = 'watchdog = "100s"\nrealtime = "off"\n'  # where it is not the watchdog that is tested


@pytest.fixture
def program(project_of):
    """``program(cyclic="...", exit="...")``: a project whose units have these bodies."""

    def program(plc=SLOW, settings="", before="", **units):
        source = f"{HEAD}{before}\nclass Main(Program):\n    pass\n"
        for unit, body in units.items():
            lines = "".join(f"        {line}\n" for line in body.splitlines())
            source += f"    def {unit}(self):\n{lines}"
        return project_of(source, plc=plc, settings=settings)

    return program


@pytest.fixture
def start():
    """``start("run", folder)``: a running plcsim, killed at the end of the test."""
    started = []

    def start(*arguments):
        process = subprocess.Popen(
            [sys.executable, "-P", "-m", "plcsim.cli.main", *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"},
        )
        started.append(process)
        return process

    yield start
    for process in started:
        process.kill()
        process.communicate()


@pytest.fixture
def finish(start):
    """``finish("run", folder)``: exit code, stdout and stderr of a plcsim that ends by itself."""

    def finish(*arguments):
        process = start(*arguments)
        out, err = process.communicate(timeout=100)
        return process.returncode, out, err

    return finish
