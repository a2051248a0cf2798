"""Automation Studio projects, written for a test."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest

HARDWARE = """<Hardware><Module Name="CP" Type="X20CP"><Parameter ID="ConfigurationID" Value="x"/>
<Parameter ID="Cyclic1Duration" Value="10000"/></Module></Hardware>"""


def _listing(lines: Sequence[str]) -> str:
    objects = (line.partition(":") for line in lines)
    inside = "\n".join(f'<Object Type="{kind}">{name}</Object>' for kind, _, name in objects)
    return f"<Package>\n<Objects>{inside}</Objects>\n</Package>"


@pytest.fixture
def write_project(tmp_path: Path) -> Callable[..., Path]:
    """``write_project(files, tasks)``: the folder of a project with these tasks in class 1.

    A list among the files is that of a package or a program: ``["File:Main.st"]``.
    """

    def call(files: Mapping[str, str | Sequence[str]], tasks: Sequence[str]) -> Path:
        lines = "\n".join(f'<Task Name="{name}" Source="{name}.prg"/>' for name in tasks)
        whole: dict[str, str | Sequence[str]] = {
            "Test.apj": "<Project/>",
            "Physical/Physical.pkg": ["Configuration:C"],
            "Physical/C/Config.pkg": ["Cpu:CP", "File:Hardware.hw"],
            "Physical/C/Hardware.hw": HARDWARE,
            "Physical/C/CP/Cpu.pkg": ["File:Cpu.sw"],
            "Physical/C/CP/Cpu.sw": f'<Sw><TaskClass Name="Cyclic#1">{lines}</TaskClass></Sw>',
        }
        for name, text in (whole | dict(files)).items():
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text if isinstance(text, str) else _listing(text), "utf-8")
        return tmp_path

    return call
