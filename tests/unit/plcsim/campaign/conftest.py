"""A small project for campaigns: a ramp whose step is a tag, and what can go wrong with it."""

import textwrap
from collections.abc import Callable
from pathlib import Path

import pytest

PROGRAM = """
    import os
    from plcsim import Program
    from st_types import DINT, REAL, var

    class Ramp(Program):
        step = var(REAL, 1.0)
        value = var(REAL)
        trouble = var(DINT)

        def cyclic(self):
            self.value += self.step
            if self.trouble == 1:
                1 / 0
            if self.trouble == 2:
                os._exit(7)
            if self.trouble == 3:
                os.system("sleep 60")
"""

HEAD = "from plcsim.campaign import *\n"


@pytest.fixture
def campaign_file(tmp_path: Path) -> Callable[[str], Path]:
    """Give a function that writes a project and the file of a campaign in it."""
    folder = tmp_path / "ramp_plc"
    (folder / "ramp").mkdir(parents=True)
    (folder / "plc.toml").write_text('[task_class.1]\ncycle = "10ms"\nprograms = ["ramp"]\n')
    (folder / "ramp" / "main.py").write_text(textwrap.dedent(PROGRAM))

    def write(text: str) -> Path:
        file = folder / "ramps.py"
        file.write_text(HEAD + textwrap.dedent(text))
        return file

    return write
