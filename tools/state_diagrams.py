"""Writes the state diagrams of the documentation from the transition tables of the code.

``python tools/state_diagrams.py`` writes them anew; a test says when that was forgotten. A page
asks for a diagram by two comments, and what stands between them is written here::

    <!-- states of plcsim.core.system:TRANSITIONS -->
    <!-- end of states -->

A table is a ``dict[State, dict[Event, State]]`` of two enumerations; its first state is where the
machine begins, and a state that nothing leads out of is where it ends. An arrow bears the value of
its event where that is a text, otherwise its name.
"""

from __future__ import annotations

import re
import sys
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from enum import Enum

    Table = Mapping[Enum, Mapping[Enum, Enum]]

TOP = Path(__file__).resolve().parent.parent

_BLOCK = re.compile(
    r"(?P<head><!-- states of (?P<module>[\w.]+):(?P<name>\w+) -->\n)"
    r".*?(?P<foot><!-- end of states -->)",
    re.DOTALL,
)


def diagram(table: Table) -> str:
    """Return a table as a Mermaid diagram, in a fenced block of Markdown."""
    return "\n".join(["```mermaid", "stateDiagram-v2", *_arrows(table), "```", ""])


def _arrows(table: Table) -> Iterator[str]:
    states = [*table, *(to for events in table.values() for to in events.values())]
    yield f"    [*] --> {states[0].name}"
    for state, events in table.items():
        for event, to in events.items():
            yield f"    {state.name} --> {to.name}: {_text(event)}"
    for state in dict.fromkeys(states):
        if not table.get(state):
            yield f"    {state.name} --> [*]"


def _text(event: Enum) -> str:
    """Return what an arrow bears; Mermaid ends a label at a semicolon."""
    text = event.value if isinstance(event.value, str) else event.name.lower().replace("_", " ")
    return text.replace(";", ",").replace(":", "")


def renew(text: str) -> str:
    """Return a page with its diagrams as the tables are now."""

    def block(found: re.Match[str]) -> str:
        table: Any = getattr(import_module(found["module"]), found["name"])
        return found["head"] + diagram(table) + found["foot"]

    return _BLOCK.sub(block, text)


def main(folder: Path = TOP / "docs") -> int:
    """Write the diagrams of all pages in a folder anew."""
    for page in sorted(folder.rglob("*.md")):
        text = page.read_text("utf-8")
        fresh = renew(text)
        if fresh != text:
            page.write_text(fresh, "utf-8")
            print(page)
    return 0


if __name__ == "__main__":
    sys.path.insert(0, str(TOP))  # the checkout's own tables, whatever is installed
    sys.exit(main())
