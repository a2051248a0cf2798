"""Blocks in a controller, and timing diagrams as text.

A diagram has one row a member and one column a call, 1 ms apart. ``_`` and ``#`` are FALSE and
TRUE, a digit is a number. Rows of inputs are played, rows of outputs are compared.
"""

from functools import cache

from plcsim.core.context import Context
from plcsim.core.memory import PAGE, Memory
from plcsim.program.loader import installed_catalogue
from plcsim.program.site import Site
from st_types.types.derived import Section
from st_types.types.views import type_of

MS = 1_000_000


@cache
def controller():
    """What all blocks of these tests lie in, as the machine takes its time to make."""
    context = Context(Memory(200 * PAGE), network=None)
    Site(context, installed_catalogue())
    return context


def new_block(block_class, release_ns=0):
    context = controller()
    context.release_ns = release_ns
    return context.memory.new(block_class, context)


def tidy(text):
    """Return the diagram as `play` lays it out."""
    lines = [line.split() for line in text.split("\n") if line.strip()]
    return "\n".join(f"{name:6} {row}" for name, row in lines)


def play(block_class, text):
    """Return the diagram with its output rows replaced by what the block gives."""
    rows = dict(line.split() for line in tidy(text).split("\n"))
    block = new_block(block_class)
    section = {name: type_of(block).find(name)[0].section for name in rows}
    played = {name: row if section[name] is Section.INPUT else "" for name, row in rows.items()}
    for column in range(len(next(iter(rows.values())))):
        inputs = {n: _value(r[column]) for n, r in rows.items() if section[n] is Section.INPUT}
        block(**inputs)
        for name in rows.keys() - inputs:
            played[name] += _mark(getattr(block, name))
        block.context.release_ns += MS
    return "\n".join(f"{name:6} {row}" for name, row in played.items())


def _value(mark):
    return mark == "#" if mark in "_#" else int(mark)


def _mark(value):
    return "_#"[value] if isinstance(value, bool) else str(value)
