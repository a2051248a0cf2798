"""Runs a project as a user does; its program measures and prints a JSON object in EXIT."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent


def run_project(folder: Path, cycles: int, *, virtual: bool, **environment: str) -> dict[str, Any]:
    """Return what the program of a project printed in its EXIT after so many cycles."""
    command = [sys.executable, "-m", "plcsim.cli.main", "run", str(folder), "--quiet"]
    clock = ["--virtual"] if virtual else []
    done = subprocess.run(
        [*command, "--cycles", str(cycles), *clock],
        stdout=subprocess.PIPE,
        text=True,
        check=True,
        env={**os.environ, **environment},
    )
    figures: dict[str, Any] = json.loads(done.stdout)
    return figures
