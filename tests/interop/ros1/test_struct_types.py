"""`types from-ros` of all messages, services and actions that are installed, and `check`."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

PLCSIM = [sys.executable, "-m", "plcsim.cli.main"]
SHARE = Path("/usr/share")


def installed() -> list[str]:
    """Return the names of all definitions below /usr/share, by their packages' manifests."""
    names = []
    for kind in ("msg", "srv", "action"):
        for file in sorted(SHARE.glob(f"*/{kind}/*.{kind}")):
            manifest = file.parent.parent / "package.xml"
            if manifest.exists():
                package = re.search(r"<name>\s*(\w+)", manifest.read_text())
                assert package
                names.append(f"{package[1]}/{file.stem}")
    return names


def test_all_that_debian_installs(tmp_path: Path, rospy_installed: None) -> None:
    names = installed()
    if not names:
        pytest.skip("no message packages are installed (tests/interop/ros1/install.sh)")
    project = tmp_path / "all"
    env = os.environ | {"ROS_PACKAGE_PATH": str(SHARE)}

    def run(*arguments: str) -> None:
        done = subprocess.run([*PLCSIM, *arguments], env=env, capture_output=True, text=True,
                              check=False)  # fmt: skip
        assert done.returncode == 0, done.stderr

    run("new", str(project))
    run("types", "from-ros", *names, "-o", str(project), "--array", "4", "--string", "20")
    run("check", str(project))
    assert len(list(project.glob("*.typ"))) >= len(set(names))
