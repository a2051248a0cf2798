"""The robot cell beside rospy, roscpp and robot_state_publisher, for less than a minute."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from .rig import ROOT

SECONDS, RESTART_S = 14, 7


def measured(result: Path) -> dict[str, Any]:
    """Run the cell for `SECONDS`; return what became of everything."""
    command = [sys.executable, str(ROOT / "benchmarks" / "ros_cell.py"), "--json", str(result)]
    command += ["--seconds", str(SECONDS), "--restart", str(RESTART_S)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=250)
    assert result.exists(), done.stderr
    found: dict[str, Any] = json.loads(result.read_text())["found"]
    return found


def program_violations(found: dict[str, Any]) -> int:
    """Return the cycle time violations that the cell's program is blamed for."""
    count: int = found["report"]["task_classes"][0]["violations"]["program"]
    return count


def test_nothing_is_lost_while_masters_die_and_a_peer_stops(
    tmp_path: Path, rospy_installed: None, roscpp: Path
) -> None:
    if not Path("/usr/lib/robot_state_publisher/robot_state_publisher").exists():
        pytest.skip("robot_state_publisher is not installed (tests/interop/ros1/install.sh)")
    found = measured(tmp_path / "found.json")
    if program_violations(found):
        # A virtual machine that stood still without saying so (timing model, "Overruns") is taken
        # for the program, and ends the cell; steps that are too long of themselves show again.
        found = measured(tmp_path / "again.json")
    report = found["report"]
    told = found["said"], *(report[key] for key in ("fault", "violations", "logbook"))
    assert (report["fault"], program_violations(found)) == (None, 0), told
    assert found["deaths"] == SECONDS // RESTART_S
    for heard, lost, beginnings, frames in found["heard"].values():
        assert (lost, beginnings) == (0, 0), told
        assert heard > 10 * SECONDS
        assert frames > 30 * SECONDS
    assert found["planner"]["ended"] == {"SUCCEEDED": found["planner"]["sent"]}, told
