"""Bodies that follow a table: outputs of a block have the value of an input, or a constant.

So a component of a vendor that nothing executes here reports at least what programs wait for before
they leave their first state: a mapp component is active when it is enabled, and has no error.
"""

from __future__ import annotations

import struct
import tomllib
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from st_types.types.derived import DataBlockType, Section, StructType, resolve_alias
from st_types.types.elementary import ElementaryType

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.core.context import Context

LANGUAGE: Final = "table"

Value = str | bool | int | float
"""An input that an output follows, or a constant."""


@dataclass(frozen=True)
class Rules:
    """What blocks do, by output.

    Attributes:
        any: of every block that has both members.
        blocks: of single blocks, by name.
        own: names of blocks that a project has rules for.
    """

    any: Mapping[str, Value] = field(default_factory=dict)
    blocks: Mapping[str, Mapping[str, Value]] = field(default_factory=dict)
    own: frozenset[str] = frozenset()

    def of(self, name: str) -> dict[str, Value]:
        """Return the rules for a block."""
        return {**self.any, **self.blocks.get(name, {})}

    def extended(self, blocks: Mapping[str, Mapping[str, Value]]) -> Rules:
        """Return the rules with those of a project added."""
        merged = {name: {**self.blocks.get(name, {}), **rules} for name, rules in blocks.items()}
        return Rules(self.any, {**self.blocks, **merged}, self.own | blocks.keys())


@cache
def built_in_rules() -> Rules:
    """Return the rules in ``simulated.toml``."""
    table = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
    return Rules(table["any"], table["blocks"])


class _Move(NamedTuple):
    """What one call does: bytes from an input, or a constant, to an output."""

    target: int
    size: int
    source: int
    data: bytes


class TableBody(NamedTuple):
    """The body of a block that follows rules; see `plcsim.library.executable.Executable`.

    Attributes:
        moves: what a call does.
        text: the same in words.
    """

    moves: tuple[_Move, ...]
    text: str

    @property
    def language(self) -> str:
        """It is a table."""
        return LANGUAGE

    def bind(self, context: Context) -> Callable[[int], None]:
        """Return what runs the block on the data block at an address."""
        memory, moves = context.memory, self.moves

        def run(address: int) -> None:
            for target, size, source, data in moves:
                value = data or memory.read(address + source, size)
                memory.write(address + target, value)

        return run


def table_body(data_type: DataBlockType[Any], rules: Mapping[str, Value]) -> TableBody | None:
    """Return a body that follows rules; None where the block has none of their members."""
    moves: list[_Move] = []
    texts: list[str] = []
    for output, value in rules.items():
        move = _move(data_type, output, value)
        if move is not None:
            moves.append(move)
            if isinstance(value, str):
                texts.append(f"{output} follows {value}")
    return TableBody(tuple(moves), ", ".join(texts)) if texts else None


def _move(data_type: StructType[Any], output: str, value: Value) -> _Move | None:
    target = _elementary(data_type, output, Section.OUTPUT)
    if target is None:
        return None
    kind, offset = target
    if not isinstance(value, str):
        return _Move(offset, kind.size, 0, struct.pack(f"<{kind.code}", value))
    source = _elementary(data_type, value, Section.INPUT)
    if source is None or source[0] is not kind:
        return None
    return _Move(offset, kind.size, source[1], b"")


def _elementary(
    data_type: StructType[Any], name: str, section: Section
) -> tuple[ElementaryType[Any], int] | None:
    for member, offset in zip(data_type.members, data_type.offsets, strict=True):
        kind = resolve_alias(member.data_type)
        if member.name == name and member.section is section and isinstance(kind, ElementaryType):
            return kind, offset
    return None
