"""A short seeded fuzz of the running tank; benchmarks/modbus_fuzz.py runs it for longer."""

import subprocess
import sys
from pathlib import Path
from typing import Any

FUZZ = Path(__file__).parents[3] / "benchmarks" / "modbus_fuzz.py"


def test_no_input_wedges_a_connection_or_gets_a_wrong_answer(tank: Any) -> None:
    done = subprocess.run(
        [sys.executable, str(FUZZ), "--port", str(tank.port), "--seconds", "4", "--seed", "7"],
        capture_output=True, text=True, timeout=200, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    assert "wedged 0, wrong function 0" in done.stdout
