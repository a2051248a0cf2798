"""The robot cell beside rospy, roscpp and robot_state_publisher, for less than a minute."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from .rig import ROOT

SECONDS, RESTART_S = 14, 7


def test_nothing_is_lost_while_masters_die_and_a_peer_stops(
    tmp_path: Path, rospy_installed: None, roscpp: Path
) -> None:
    if not Path("/usr/lib/robot_state_publisher/robot_state_publisher").exists():
        pytest.skip("robot_state_publisher is not installed (tests/interop/ros1/install.sh)")
    result = tmp_path / "found.json"
    command = [sys.executable, str(ROOT / "benchmarks" / "ros_cell.py"), "--json", str(result)]
    command += ["--seconds", str(SECONDS), "--restart", str(RESTART_S)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=250)
    assert result.exists(), done.stderr
    found = json.loads(result.read_text())["found"]
    assert found["deaths"] == SECONDS // RESTART_S
    for heard, lost, beginnings, frames in found["heard"].values():
        assert (lost, beginnings) == (0, 0)
        assert heard > 10 * SECONDS
        assert frames > 30 * SECONDS
    assert found["planner"]["ended"] == {"SUCCEEDED": found["planner"]["sent"]}
    assert found["report"]["task_classes"][0]["violations"]["program"] == 0
