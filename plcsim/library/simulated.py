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

Value = str | list[str] | bool | int | float
"""An input that an output follows, several of which the first that is not 0 counts, or a
constant."""


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
    """What one call does: bytes to an output.

    Attributes:
        target: offset of the output.
        size: of it, bytes.
        sources: offsets of inputs, of which the first that is not 0 counts; empty for a constant.
        data: the constant.
        followed: names of the inputs.
    """

    target: int
    size: int
    sources: tuple[int, ...]
    data: bytes
    followed: tuple[str, ...] = ()


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
            for target, size, sources, data, _ in moves:
                value = data
                for source in sources:
                    value = memory.read(address + source, size)
                    if any(value):
                        break
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
            if move.followed:
                texts.append(f"{output} follows {' or '.join(move.followed)}")
    return TableBody(tuple(moves), ", ".join(texts)) if texts else None


def _move(data_type: StructType[Any], output: str, value: Value) -> _Move | None:
    target = _elementary(data_type, output, Section.OUTPUT)
    if target is None:
        return None
    kind, offset = target
    if not isinstance(value, (str, list)):
        return _Move(offset, kind.size, (), struct.pack(f"<{kind.code}", value))
    names = [value] if isinstance(value, str) else value
    found = {name: _elementary(data_type, name, Section.INPUT) for name in names}
    places = {name: each[1] for name, each in found.items() if each and each[0] is kind}
    if not places:
        return None
    return _Move(offset, kind.size, tuple(places.values()), b"", tuple(places))


def _elementary(
    data_type: StructType[Any], name: str, section: Section
) -> tuple[ElementaryType[Any], int] | None:
    for member, offset in zip(data_type.members, data_type.offsets, strict=True):
        kind = resolve_alias(member.data_type)
        if member.name == name and member.section is section and isinstance(kind, ElementaryType):
            return kind, offset
    return None
