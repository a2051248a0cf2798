"""A short seeded attack on processes of ours, without ROS; benchmarks/ros_fuzz.py runs longer."""

import subprocess
import sys
from pathlib import Path

FUZZ = Path(__file__).parents[3] / "benchmarks" / "ros_fuzz.py"


def test_hostile_peers_at_every_port_cost_no_message_no_cycle_and_no_memory() -> None:
    done = subprocess.run(
        [sys.executable, str(FUZZ), "--seconds", "5", "--seed", "7"],
        capture_output=True, text=True, timeout=180, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    assert "faults: 0" in done.stdout
