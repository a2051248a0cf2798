"""Files of Automation Studio, written for a test."""

from collections.abc import Callable
from pathlib import Path

import pytest

BOTTLING = Path(__file__).parents[4] / "data" / "automation_studio" / "Bottling"


@pytest.fixture
def write(tmp_path: Path) -> Callable[[dict[str, str]], Path]:
    """``write({"a/b.txt": "text"})``: the folder in which these files lie."""

    def call(texts: dict[str, str]) -> Path:
        for name, text in texts.items():
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")
        return tmp_path

    return call


@pytest.fixture
def bottling() -> Path:
    """The project that holds everything the readers know."""
    return BOTTLING
