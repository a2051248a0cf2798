"""Debian's rospy, for benchmarks that measure beside it."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Final

PYTHON: Final = "/usr/bin/python3"
HOST_ENVIRONMENT: Final = {"ROS_IP": "127.0.0.1", "PATH": "/usr/bin:/bin"}


def rospy_command(script: str) -> list[str] | None:
    """Return what runs a script that imports rospy, None where rospy is not installed."""
    probe = [PYTHON, "-c", "import rospy, std_msgs.msg"]
    if not Path(PYTHON).exists():
        return None
    if subprocess.run(probe, capture_output=True, check=False).returncode:
        return None
    return [PYTHON, "-W", "ignore", "-c", script]
