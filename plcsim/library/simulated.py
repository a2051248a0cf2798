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

from plcsim.library.runtime import ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE, ERR_OK
from st_types.types.derived import DataBlockType, Section, StructType, resolve_alias
from st_types.types.elementary import BOOL, UDINT, UINT, ElementaryType

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.core.context import Context
    from plcsim.core.memory import Memory

LANGUAGE: Final = "table"

Value = str | list[str] | bool | int | float
"""An input that an output follows, several of which the first that is not 0 counts, or a
constant. ``"Home while Enable"`` takes Home once that is not 0, and keeps it while Enable is not
0; ``"1 once enable"`` is 1 from the first call on in which enable is not 0."""

_WHILE: Final = " while "
_ONCE: Final = " once "
_ANY_NAME: Final = "*"


@dataclass(frozen=True)
class Rules:
    """What blocks do, by output.

    Attributes:
        any: of every block that has both members; ``"*Done"`` with ``"*"`` are all outputs with the
            name of an input before Done, ``"*Initialized"`` with ``"Init*"`` likewise.
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


_STATE_NAMES: Final = frozenset(
    ["i_state", "intstate", "stateman", "_statemachine", "intern", "_internal"]
)
"""Members that asynchronous blocks of the controller's libraries keep their state in."""


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
        kept: offset of the input as long as which, not 0, the output keeps what is not 0; None
            where it does not.
        once: offset and size of the input without which the output stays as it is; None where
            there is none.
    """

    target: int
    size: int
    sources: tuple[int, ...]
    data: bytes
    followed: tuple[str, ...] = ()
    kept: int | None = None
    once: tuple[int, int] | None = None


class _Status(NamedTuple):
    """The output ``status`` of a block with ``enable``, as all libraries of the controller have it.

    Attributes:
        target: offset of it.
        size: of it, bytes.
        enable: offset of the input.
        is_asynchronous: the block is BUSY in one call, and done in the next.
        end: what it is when the block is done.
    """

    target: int
    size: int
    enable: int
    is_asynchronous: bool
    end: int

    def apply(self, memory: Memory, address: int) -> None:
        """Do what one call does."""
        target = address + self.target
        status = ERR_FUB_ENABLE_FALSE
        if any(memory.read(address + self.enable, 1)):
            before = int.from_bytes(memory.read(target, self.size), "little")
            is_begun = not self.is_asynchronous or before == ERR_FUB_BUSY
            status = self.end if is_begun else ERR_FUB_BUSY
        memory.write(target, status.to_bytes(self.size, "little"))

    @property
    def text(self) -> str:
        """The same in words."""
        return f"status is {'BUSY once, then ' if self.is_asynchronous else ''}{self.end}"


class TableBody(NamedTuple):
    """The body of a block that follows rules; see `plcsim.library.executable.Executable`.

    Attributes:
        moves: what a call does.
        text: the same in words.
        size: of a data block, bytes.
        status: what becomes of ``status``, None where it has none.
    """

    moves: tuple[_Move, ...]
    text: str
    size: int
    status: _Status | None = None

    @property
    def language(self) -> str:
        """It is a table."""
        return LANGUAGE

    def bind(self, context: Context) -> Callable[[int], None]:
        """Return what runs the block on the data block at an address."""
        memory, moves, size, status = context.memory, self.moves, self.size, self.status
        last: dict[int, bytes] = {}

        def run(address: int) -> None:
            if status is not None:
                status.apply(memory, address)
            # What is as the last call left it stays so: outputs depend on inputs alone.
            if memory.read(address, size) != last.get(address):
                for move in moves:
                    _apply(move, memory, address)
                last[address] = memory.read(address, size)

        return run


class ResultBody(NamedTuple):
    """The body of a function with a constant result; see `plcsim.library.executable.Executable`.

    Attributes:
        result: of every call.
    """

    result: bool | float

    @property
    def language(self) -> str:
        """It is a table."""
        return LANGUAGE

    @property
    def text(self) -> str:
        """What it does, in words."""
        return f"returns {self.result}"

    def bind(self, _context: Context) -> Callable[..., bool | float]:
        """Return what gives the result."""
        result = self.result

        def run(*_parameters: object) -> bool | float:
            return result

        return run


def result_body(name: str, rules: Mapping[str, Value]) -> ResultBody | None:
    """Return the body of a function that a rule gives a result; None without one."""
    result = rules.get(name)
    return None if result is None or isinstance(result, str | list) else ResultBody(result)


def _apply(move: _Move, memory: Memory, address: int) -> None:
    value, size = move.data, move.size
    if move.once is not None and not any(memory.read(address + move.once[0], move.once[1])):
        return
    for source in move.sources:
        value = memory.read(address + source, size)
        if any(value):
            break
    if move.kept is not None:
        if not any(memory.read(address + move.kept, size)):
            value = bytes(size)
        elif not any(value):
            return
    memory.write(address + move.target, value)


def table_body(data_type: DataBlockType[Any], rules: Mapping[str, Value]) -> TableBody | None:
    """Return a body that follows rules; None where the block has none of their members."""
    exact = {name: value for name, value in rules.items() if _ANY_NAME not in name}
    moves: list[_Move] = []
    texts: list[str] = []
    for output, value in {**_named(data_type, rules), **exact}.items():
        move = _move(data_type, output, value)
        if move is not None:
            moves.append(move)
            if move.followed:
                texts.append(f"{output} follows {' or '.join(move.followed)}")
            elif move.once is not None:
                texts.append(f"{output} is {value}")
    status = _status(data_type, rules.get("status", ERR_OK))
    if status is not None:
        moves = [each for each in moves if each.target != status.target]
        texts.append(status.text)
    return TableBody(tuple(moves), ", ".join(texts), data_type.size, status) if texts else None


def _status(data_type: StructType[Any], end: Value) -> _Status | None:
    """Return what becomes of ``status``: libraries of the controller spell it so.

    None where a rule gives it another end than a number.
    """
    names = {each.name for each in data_type.members}
    enable = _elementary(data_type, "enable", Section.INPUT)
    status = _elementary(data_type, "status", Section.OUTPUT)
    if not names >= {"enable", "status"} or enable is None or status is None:
        return None
    if enable[0] is not BOOL or status[0] not in (UINT, UDINT) or not isinstance(end, int):
        return None
    is_asynchronous = any(name.lower() in _STATE_NAMES for name in names)
    return _Status(status[1], status[0].size, enable[1], is_asynchronous, end)


def _named(data_type: StructType[Any], rules: Mapping[str, Value]) -> dict[str, Value]:
    """Return what rules for any name say of the outputs of a block."""
    inputs = [each.name for each in data_type.members if each.section is Section.INPUT]
    found: dict[str, Value] = {}
    for output, value in rules.items():
        if not isinstance(value, str) or _ANY_NAME not in value:
            continue
        before, _, behind = value.partition(_ANY_NAME)
        for name in inputs:
            middle = name.removeprefix(before).removesuffix(behind)
            if f"{before}{middle}{behind}" == name:
                found[output.replace(_ANY_NAME, middle)] = name
    return found


def _move(data_type: StructType[Any], output: str, value: Value) -> _Move | None:
    target = _elementary(data_type, output, Section.OUTPUT)
    if target is None:
        return None
    kind, offset = target
    if not isinstance(value, (str, list)):
        return _Move(offset, kind.size, (), struct.pack(f"<{kind.code}", value))
    names = [value] if isinstance(value, str) else value
    number, once, trigger = names[0].partition(_ONCE)
    if once:
        return _move_once(data_type, kind, offset, number, trigger)
    _, _, keeper = names[-1].partition(_WHILE)
    names = [name.partition(_WHILE)[0] for name in names]
    found = {name: _elementary(data_type, name, Section.INPUT) for name in (*names, keeper)}
    places = {name: each[1] for name, each in found.items() if each and each[0] is kind}
    kept = places.pop(keeper, None)
    if not places or (keeper and kept is None):
        return None
    return _Move(offset, kind.size, tuple(places.values()), b"", tuple(places), kept)


def _move_once(
    data_type: StructType[Any], kind: ElementaryType[Any], offset: int, number: str, trigger: str
) -> _Move | None:
    """Return what ``"1 once enable"`` says; None without a number, or such an input."""
    found = _elementary(data_type, trigger, Section.INPUT)
    if found is None or not number.isdecimal():
        return None
    data = struct.pack(f"<{kind.code}", int(number))
    return _Move(offset, kind.size, (), data, once=(found[1], found[0].size))


def _elementary(
    data_type: StructType[Any], name: str, section: Section | None
) -> tuple[ElementaryType[Any], int] | None:
    """Return type and offset of a member, or of a member ``Info.Ready`` of it, in any case."""
    first, _, rest = name.upper().partition(".")
    for member, offset in zip(data_type.members, data_type.offsets, strict=True):
        if member.name.upper() != first or section not in (None, member.section):
            continue
        kind = resolve_alias(member.data_type)
        if rest and isinstance(kind, StructType):
            inner = _elementary(kind, rest, None)
            return None if inner is None else (inner[0], offset + inner[1])
        if not rest and isinstance(kind, ElementaryType):
            return kind, offset
    return None
