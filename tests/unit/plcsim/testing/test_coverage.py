"""Structured Text in reports of coverage.py."""

import json
import os
import subprocess
import sys

import pytest

pytest.importorskip("coverage")

FILES = {
    "plc.toml": '[task_class.1]\ncycle = "10ms"\nprograms = ["main"]\n',
    "main/Main.st": (
        "PROGRAM _CYCLIC\nn := n + 1;\nIF n > 100 THEN\n\tn := 0;\nEND_IF\nEND_PROGRAM\n"
    ),
    "main/Main.var": "VAR n : INT; END_VAR\n",
    "test_main.py": 'def test_main(plc):\n    plc.cycles(3)\n    assert plc["main.n"] == 3\n',
}


@pytest.fixture
def report(tmp_path):
    """``report(branch)``: what coverage.py says of ``main/Main.st``."""
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)

    def report(branch):
        settings = f"[run]\nbranch = {branch}\nplugins = plcsim.testing.coverage\n"
        (tmp_path / ".coveragerc").write_text(settings)
        environment = os.environ | {"XDG_CACHE_HOME": str(tmp_path / "cache")}
        for command in (["run", "-m", "pytest", "-q", "test_main.py"], ["json", "-q"]):
            subprocess.run(
                [sys.executable, "-m", "coverage", *command],
                cwd=tmp_path,
                env=environment,
                check=True,
                capture_output=True,
            )
        return json.loads((tmp_path / "coverage.json").read_text())["files"]["main/Main.st"]

    return report


@pytest.mark.parametrize("branch", [False, True])
def test_lines_and_branches_are_in_its_report(report, branch):
    found = report(branch)
    assert found["executed_lines"] == [2, 3]
    assert found["missing_lines"] == [4]
    if branch:
        assert found["missing_branches"] == [[3, 4]]
        assert found["summary"]["covered_branches"] == 1
