"""Networks of a Ladder Diagram, as Automation Studio's XML has them.

A network is a grid: rows of cells, all as wide as a contact. ``or`` at a cell is a vertical line at
its right edge that joins it to the row above. A block takes one cell in each of several rows of a
column: its header, then one for each pair of an input and an output.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, Literal, cast

from plcsim.program.structured_text.codes import FindingCode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.library.document import XmlElement
    from plcsim.program.structured_text.languages.placed import PlacedTokens
    from st_types.syntax.diagnostics import DiagnosticLog

MAX_COLUMNS: Final = 100
"""Cells of a row; bounds the depth of what is made of it."""

MAX_ROWS: Final = 5000
"""Rows of a network."""

CellKind = Literal["contact", "coil", "analog", "line", "empty", "block"]

_TYPES: Final = {
    "contact": frozenset(
        ["open", "closed", "positive transition", "negative transition", "address"]
    ),
    "coil": frozenset(
        [
            *("open", "closed", "set", "reset", "jump", "return"),
            *("positive transition", "negative transition"),
        ]
    ),
}
_BLOCKS: Final = ("function", "functionblock")
_INSIDE: Final = ("", "middle", "bottom")
"""Positions of parts of a block that are not its first."""

_ATTRIBUTES: Final = {
    "networks": frozenset(["maxcolumn"]),
    "network": frozenset(["label", "comment", "row", "column", "commented"]),
    "row": frozenset[str](),
    "contact": frozenset(["name", "type", "or", "comment"]),
    "coil": frozenset(["name", "type", "or", "comment"]),
    "analog": frozenset(["name", "type", "or", "comment"]),
    "line": frozenset(["or"]),
    "empty": frozenset(["or"]),
    "function": frozenset(["name", "type", "position", "or", "comment"]),
    "functionblock": frozenset(["name", "type", "position", "or", "comment"]),
    "input": frozenset(["name"]),
    "output": frozenset(["name"]),
}
_VALUES: Final = {key: re.compile(rf"\s{key}\s*=\s*[\"']") for key in ("name", "type")}
_CHANGES: Final = re.compile(
    r"neg|inv|not|edge|trans|rising|falling|able|comment|type|expr|value|order|prio", re.IGNORECASE
)
"""Part of the name of an attribute that may change what a network does."""

_NOT_SET: Final = frozenset(["", "0", "false"])
_SET: Final = frozenset(["1", "true"])


@dataclass(slots=True)
class Pin:
    """An input or output of a block.

    Attributes:
        name: as the block declares it, may be empty.
        at: number of its token.
        row: of the network.
    """

    name: str
    at: int
    row: int


@dataclass(slots=True)
class LadderBlock:
    """A function or a function block in a network.

    Attributes:
        at: number of the token of its type.
        column: of the network.
        has_instance: it is a function block.
        type: of it, the name of a function.
        name: what its header says, the instance of a function block; may be empty.
        operand: number of the first token of the name.
        inputs: from the top.
        outputs: likewise.
    """

    at: int
    column: int
    has_instance: bool
    type: str = ""
    name: str = ""
    operand: int = 0
    inputs: list[Pin] = field(default_factory=list)
    outputs: list[Pin] = field(default_factory=list)


@dataclass(slots=True)
class Cell:
    """One place of the grid.

    Attributes:
        kind: what is there.
        at: number of the first token of its operand, or of the cell where it has none.
        type: of a contact or a coil.
        name: of the operand as it is written.
        joins: a vertical line at its right edge leads up to the row above.
        block: that covers it.
    """

    kind: CellKind
    at: int
    type: str = ""
    name: str = ""
    joins: bool = False
    block: LadderBlock | None = None


@dataclass(slots=True)
class LadderNetwork:
    """A network.

    Attributes:
        number: from 1.
        at: number of its token.
        label: where jumps lead to, may be empty.
        rows: of cells.
        blocks: in it.
    """

    number: int
    at: int
    label: str
    rows: list[list[Cell]] = field(default_factory=list)
    blocks: list[LadderBlock] = field(default_factory=list)


class NetworkReader:
    """Makes networks of elements; an element that it does not know is an error.

    Args:
        text: the file.
        base: offset of the document in the file.
        tokens: take the operands.
        diagnostics: take what is wrong.
    """

    def __init__(
        self, text: str, base: int, tokens: PlacedTokens, diagnostics: DiagnosticLog
    ) -> None:
        self._text = text
        self._tokens = tokens
        self._diagnostics = diagnostics
        self._number = 0
        self._bytes, self._offset = 0, base

    def networks(self, root: XmlElement) -> Iterator[LadderNetwork]:
        """Yield the networks that are not commented out."""
        if root.tag != "networks":
            self._fail(self._place(root), f"expected <networks>, found <{root.tag}>")
            return
        self._checked(root, self._place(root))
        for self._number, element in enumerate(root.children, 1):
            place = self._place(element)
            if element.tag != "network":
                self._fail(place, f"element <{element.tag}> is not known")
            elif not self._is_set(element, "commented", place):
                yield self._network(element, place)

    def _network(self, element: XmlElement, place: int) -> LadderNetwork:
        self._checked(element, place)
        label = element.get("label").strip()
        found = LadderNetwork(self._number, self._tokens.mark(place, label or "<network>"), label)
        if len(element.children) > MAX_ROWS:
            self._fail(place, f"has more than {MAX_ROWS} rows")
            return found
        open_blocks: dict[int, LadderBlock] = {}
        for row in element.children:
            place = self._place(row)
            self._checked(row, place)
            if row.tag != "row":
                self._fail(place, f"element <{row.tag}> is not known")
            elif len(row.children) > MAX_COLUMNS:
                self._fail(place, f"a row has more than {MAX_COLUMNS} cells")
            else:
                found.rows.append(self._row(row, found, open_blocks))
        for block in found.blocks:
            if block.name and not block.type and not block.has_instance:
                block.type, block.at = block.name, block.operand
        return found

    def _row(
        self, row: XmlElement, network: LadderNetwork, blocks: dict[int, LadderBlock]
    ) -> list[Cell]:
        cells = []
        for column, element in enumerate(row.children):
            place = self._place(element)
            if element.tag in _BLOCKS:
                cell = self._block_cell(element, place, network, blocks, column)
            else:
                blocks.pop(column, None)
                cell = self._cell(element, place)
            cell.joins = self._is_set(element, "or", place)
            cells.append(cell)
        return cells

    def _cell(self, element: XmlElement, place: int) -> Cell:
        self._checked(element, place)
        tag, kind, name = element.tag, element.get("type"), element.get("name").strip()
        if tag in ("line", "empty"):
            return Cell(cast("CellKind", tag), self._tokens.mark(place, f"<{tag}>"))
        if tag not in ("contact", "coil", "analog"):
            self._fail(place, f"element <{tag}> is not known")
            return Cell("empty", self._tokens.mark(place))
        if tag in _TYPES and kind not in _TYPES[tag]:
            self._fail(place, f"the type {kind!r} of a {tag} is not known")
        if not name and kind != "return":
            self._fail(place, f"a {tag} has no name")
        at = self._operand(element, place, "name")
        return Cell(cast("CellKind", tag), at, kind, name)

    def _block_cell(
        self,
        element: XmlElement,
        place: int,
        network: LadderNetwork,
        blocks: dict[int, LadderBlock],
        column: int,
    ) -> Cell:
        """Return a part of a block; it begins with its header, or with its top."""
        self._checked(element, place)
        position = element.get("position")
        has_instance = element.tag == "functionblock"
        block = blocks.get(column)
        begins = position == "header" or (position not in _INSIDE and _is_whole(block))
        if block is None or begins or block.has_instance != has_instance:
            block = blocks[column] = LadderBlock(self._tokens.mark(place), column, has_instance)
            network.blocks.append(block)
        self._describe(block, element, place)
        for pin in element.children:
            at = self._place(pin)
            self._checked(pin, at)
            token = self._tokens.mark(at, pin.get("name") or "<pin>")
            found = Pin(pin.get("name").strip(), token, len(network.rows))
            if pin.tag in ("input", "output"):
                (block.inputs if pin.tag == "input" else block.outputs).append(found)
            else:
                self._fail(at, f"element <{pin.tag}> of a block is not known")
        if position == "bottom":
            del blocks[column]
        return Cell("block", block.at, block=block)

    def _describe(self, block: LadderBlock, element: XmlElement, place: int) -> None:
        """Take the type and the name that a part of a block tells."""
        kind, name = element.get("type").strip(), element.get("name").strip()
        if kind and not block.type:
            block.type = kind
            block.at = self._operand(element, place, "type")
        if name and not block.name:
            block.name = name
            block.operand = self._operand(element, place, "name")

    def _operand(self, element: XmlElement, place: int, key: str) -> int:
        """Add the tokens of an attribute."""
        value = element.get(key)
        match = _VALUES[key].search(self._text, place)
        inside = match is not None and match.start() < self._text.find(">", place)
        start = match.end() if match is not None and inside else place
        return self._tokens.operand(start, value)

    def _checked(self, element: XmlElement, place: int) -> None:
        """Tell of attributes that are not known and say something.

        One that may change what the network does is an error; another, such as a width, a warning.
        """
        known = _ATTRIBUTES.get(element.tag, frozenset())
        for key, value in element.attributes.items():
            is_known = key in known or key.startswith("xmlns") or value.lower() in _NOT_SET
            if is_known or element.tag not in _ATTRIBUTES:
                continue
            message = f"the attribute {key}={value!r} of <{element.tag}> is not known"
            if _CHANGES.search(key):
                self._fail(place, message)
            else:
                code = FindingCode.NOT_SUPPORTED
                self._diagnostics.warning(place, self._told(message), "", code)

    def _is_set(self, element: XmlElement, key: str, place: int) -> bool:
        value = element.get(key).strip().lower()
        if value not in _SET and value not in _NOT_SET:
            self._fail(place, f"{key}={value!r} is neither true nor false")
        return value in _SET

    def _place(self, element: XmlElement) -> int:
        """Return the offset of an element; elements are asked for in the order of the file."""
        self._offset = _after(self._text, self._offset, element.offset - self._bytes)
        self._bytes = element.offset
        return self._offset

    def _fail(self, offset: int, message: str) -> None:
        self._diagnostics.error(offset, self._told(message))

    def _told(self, message: str) -> str:
        """Return a message with the number of the network."""
        return f"network {self._number}: {message}" if self._number else message


def _is_whole(block: LadderBlock | None) -> bool:
    """Return whether a block has its pins already, so that another top begins another block."""
    return block is not None and bool(block.inputs or block.outputs)


def _after(text: str, offset: int, count: int) -> int:
    """Return the offset that lies a number of bytes of UTF-8 behind another."""
    part = text[offset : offset + count].encode("utf-8", "replace")[:count]
    return offset + len(part.decode("utf-8", "ignore"))
