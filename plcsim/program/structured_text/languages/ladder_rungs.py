"""What a network of a Ladder Diagram does, as statements.

Power flows from the left rail to the right: a cell hands on what reaches its left edge, a vertical
line ORs what reaches it and hands that to all cells at its right (IEC 61131-3, 8.2). Coils and
blocks are carried out from the top row down, in a row from left to right, and each takes what leads
to it when its turn has come, so that a contact below a coil of the same variable reads the new
value. What leads to several of them is worked out once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.languages.nodes import NodeMaker
from plcsim.program.structured_text.syntax.tree import (
    Arm,
    Assignment,
    ExpressionStatement,
    IfStatement,
    JumpStatement,
    LabelStatement,
    ReturnStatement,
    TemporaryStatement,
)
from st_types.syntax.expressions import (
    Argument,
    Binary,
    Call,
    Literal,
    MemberAccess,
    Name,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.program.structured_text.languages.ladder_networks import (
        Cell,
        LadderBlock,
        LadderNetwork,
        Pin,
    )
    from plcsim.program.structured_text.languages.placed import OperandParser
    from plcsim.program.structured_text.syntax.tree import Statement
    from st_types.syntax.expressions import Expression

COMPARE: Final = "Compare!"
COMPUTE: Final = "Compute!"
"""Functions whose name is an expression."""

_EDGES: Final = {"positive transition": "EDGEPOS", "negative transition": "EDGENEG"}
_SETS: Final = {"set": "S=", "reset": "R="}
_ENABLE, _ENABLED = "EN", "ENO"


class NetworkStatements:
    """Makes the statements of one network.

    Args:
        network: as it is drawn.
        parser: of its operands; takes what is wrong.
    """

    def __init__(self, network: LadderNetwork, parser: OperandParser) -> None:
        self._network = network
        self._rows = network.rows
        self._parser = parser
        self._rail: Expression = NodeMaker(network.at).literal("TRUE")
        self._edges: dict[int, list[range]] = {}
        self._known: dict[tuple[int, int], Expression | None] = {}
        self._results: dict[int, Expression] = {}
        self._done: set[int] = set()
        self._stored: set[tuple[int, int]] = set()
        self._conditional: set[str] = set()
        self._found: list[Statement] = []
        self._temporaries = 0

    def statements(self) -> list[Statement]:
        """Return them, the label first."""
        network = self._network
        if network.label:
            self._found.append(LabelStatement(network.at, network.label))
        for row, cells in enumerate(self._rows):
            for column, cell in enumerate(cells):
                if cell.kind == "coil":
                    self._coil(cell, row, column)
                elif cell.kind == "analog":
                    self._stored_value(cell, row, column)
                elif cell.block is not None:
                    self._carry_out(cell.block)
        return self._found

    # What flows

    def _cell(self, row: int, column: int) -> Cell | None:
        """Return a cell, None outside of the grid."""
        if not 0 <= row < len(self._rows) or column >= len(self._rows[row]):
            return None
        return self._rows[row][column]

    def _joined(self, row: int, edge: int) -> range:
        """Return the rows that a vertical line at an edge joins with a row."""
        if edge not in self._edges:
            self._edges[edge] = self._joined_rows(edge)
        return self._edges[edge][row]

    def _joined_rows(self, edge: int) -> list[range]:
        """Return for each row those that a vertical line at an edge joins it with."""
        found: list[range] = []
        first = 0
        for row in range(len(self._rows)):
            below = self._cell(row + 1, edge - 1)
            if below is None or not below.joins:
                found += [range(first, row + 1)] * (row + 1 - first)
                first = row + 1
        return found

    def _reaching(self, row: int, edge: int) -> Expression | None:
        """Return what reaches an edge of a row, None where nothing leads to it."""
        if not edge:
            return self._rail
        rows = self._joined(row, edge)
        key = rows.start, edge
        if key not in self._known:
            values = [value for each in rows if (value := self._leaving(each, edge - 1))]
            found = NodeMaker(values[0].at).joined("OR", values) if values else None
            if any(value is self._rail for value in values):
                found = self._rail
            if found is not None and sum(self._takers(each, edge) for each in rows) > 1:
                found = self._kept(found)
            self._known[key] = found
        return self._known[key]

    def _takers(self, row: int, edge: int) -> int:
        """Return how many times a cell takes what reaches its left edge."""
        cell = self._cell(row, edge)
        if cell is None or cell.kind == "empty":
            return 0
        if cell.kind in ("coil", "analog"):  # which hand on what they take
            following = self._cell(row, edge + 1)
            return 1 if following is None or following.kind == "empty" else 2
        return 1

    def _leaving(self, row: int, column: int) -> Expression | None:
        """Return what leaves a cell at its right edge."""
        cell = self._cell(row, column)
        if cell is None or cell.kind == "empty":
            return None
        if cell.block is not None:
            return self._output(cell.block, row)
        value = self._reaching(row, column)
        if cell.kind == "contact":
            return self._contact(cell, value)
        is_source = cell.kind == "analog" and (value is None or value is self._rail)
        return self._operand(cell) if is_source else value

    def _contact(self, cell: Cell, power: Expression | None) -> Expression | None:
        operand = self._operand(cell)
        if cell.type == "address":
            return NodeMaker(cell.at).call("ADR", operand)
        if power is None:
            self._fail(cell.at, f"nothing leads to the contact {cell.name}")
            return operand
        if cell.type == "closed":
            operand = NodeMaker(cell.at).negated(operand)
        elif cell.type in _EDGES:
            operand = NodeMaker(cell.at).call(_EDGES[cell.type], operand)
        return operand if power is self._rail else NodeMaker(cell.at).binary("AND", power, operand)

    def _kept(self, value: Expression) -> Expression:
        """Return a value that is worked out here and now, once."""
        if isinstance(value, Name | Literal):
            return value
        return self._temporary(value.at, value, self._found)

    def _temporary(self, at: int, value: Expression, into: list[Statement]) -> Name:
        self._temporaries += 1
        name = f"network {self._network.number} value {self._temporaries}"
        into.append(TemporaryStatement(at, name, value))
        return Name(at, name)

    # What is done

    def _coil(self, cell: Cell, row: int, column: int) -> None:
        power = self._reaching(row, column)
        if power is None:
            self._fail(cell.at, f"nothing leads to the coil {cell.name}")
        elif cell.type == "jump":
            self._when(cell.at, power, JumpStatement(cell.at, cell.name))
        elif cell.type == "return":
            self._when(cell.at, power, ReturnStatement(cell.at))
        else:
            operator = _SETS.get(cell.type, ":=")
            if cell.type == "closed":
                power = NodeMaker(cell.at).negated(power)
            elif cell.type in _EDGES:
                power = NodeMaker(cell.at).call(_EDGES[cell.type], power)
            target = self._operand(cell)
            self._found.append(Assignment(cell.at, target, power, operator))

    def _when(self, at: int, power: Expression, *statements: Statement) -> None:
        """Add statements that are carried out where power is on."""
        if power is self._rail:
            self._found += statements
        else:
            self._found.append(IfStatement(at, [Arm(at, power, [*statements])], None))

    def _stored_value(self, cell: Cell, row: int, column: int) -> None:
        """Store what reaches an analog operand; one that nothing leads to is an input."""
        if (row, column) in self._stored:
            return
        value = self._reaching(row, column)
        if self._is_conditional(value):
            message = f"{cell.name} takes a result that is only there when {_ENABLE} is TRUE"
            self._fail(cell.at, f"{message}; connect it to the block directly")
        if value is not None and value is not self._rail:
            self._found.append(Assignment(cell.at, self._operand(cell), value))

    def _is_conditional(self, value: Expression | None) -> bool:
        """Return whether a value is, or ORs, the result of a function that EN may leave out."""
        if isinstance(value, Binary):
            return self._is_conditional(value.left) or self._is_conditional(value.right)
        return isinstance(value, Name) and value.name in self._conditional

    # Blocks

    def _carry_out(self, block: LadderBlock) -> None:
        """Call a block, once."""
        if id(block) in self._done:
            return
        self._done.add(id(block))
        if not block.type:
            self._fail(block.at, "a block has no type")
        elif block.has_instance:
            self._call_instance(block)
        elif block.type in (COMPARE, COMPUTE):
            self._compute(block)
        else:
            self._call_function(block)

    def _output(self, block: LadderBlock, row: int) -> Expression | None:
        """Return what leaves a block in a row."""
        self._carry_out(block)
        pin = next((each for each in block.outputs if each.row == row), None)
        return None if pin is None else self._results.get(pin.at)

    def _given(self, block: LadderBlock, pin: Pin) -> Expression | None:
        return self._reaching(pin.row, block.column)

    def _call_instance(self, block: LadderBlock) -> None:
        instance = self._parser.operand(block.operand) if block.name else None
        if instance is None:
            self._fail(block.at, f"the function block of type {block.type} has no instance")
            return
        given: list[Argument] = []
        for pin in block.inputs:
            value = self._given(block, pin)
            if value is not None:
                given.append(Argument(pin.at, self._named(block, pin), value))
        for pin in block.outputs:
            if pin.name.upper() == _ENABLED:
                enabled = self._temporary(pin.at, NodeMaker(pin.at).literal("FALSE"), self._found)
                given.append(Argument(pin.at, pin.name, enabled, is_output=True))
                self._results[pin.at] = enabled
            else:
                self._results[pin.at] = MemberAccess(pin.at, instance, self._named(block, pin))
        self._found.append(ExpressionStatement(block.at, Call(block.at, instance, given)))

    def _named(self, block: LadderBlock, pin: Pin) -> str:
        if not pin.name:
            self._fail(pin.at, f"an input or output of {block.name} has no name")
        return pin.name

    def _call_function(self, block: LadderBlock) -> None:
        inputs = [pin for pin in block.inputs if pin.name.upper() != _ENABLE]
        given = []
        for number, pin in enumerate(inputs, 1):
            value = self._given(block, pin)
            if value is None:
                which = pin.name or f"number {number}"
                self._fail(pin.at, f"nothing leads to the input {which} of {block.type}")
            else:
                given.append(Argument(pin.at, "", value))
        enable = next((pin for pin in block.inputs if pin not in inputs), None)
        power = self._rail if enable is None else self._given(block, enable)
        call = Call(block.at, Name(block.at, block.type), given)
        self._evaluate(block, power, call)

    def _compute(self, block: LadderBlock) -> None:
        """Work out the expression that is the name of a Compare! or Compute!."""
        value = self._parser.operand(block.operand) if block.name else None
        if value is None or len(block.inputs) > 1:
            self._fail(block.at, f"{block.type} {block.name!r} is not known")
            return
        power = self._given(block, block.inputs[0]) if block.inputs else self._rail
        if block.type == COMPARE and power is not None:
            both = NodeMaker(block.at).binary("AND", power, value)
            value = value if power is self._rail else both
            power = self._rail
        self._evaluate(block, power, value)

    def _evaluate(self, block: LadderBlock, power: Expression | None, value: Expression) -> None:
        """Let a function have its result, and store it where power is on."""
        if power is None:
            self._fail(block.at, f"nothing leads to {_ENABLE} of {block.type}")
            return
        power = self._kept(power)
        results = [pin for pin in block.outputs if pin.name.upper() != _ENABLED]
        if block.type == COMPARE:  # whose only output is its result, whatever it is called
            results = results or block.outputs[:1]
        for pin in block.outputs:
            self._results[pin.at] = power  # that of ENO; the others follow
        if len(results) > 1:
            self._fail(results[1].at, f"{block.type} has several results")
        body: list[Statement] = []
        if not results:
            body.append(ExpressionStatement(block.at, value))
        else:
            result = self._result(block, results[0], value, body)
            self._results[results[0].at] = result
            if power is not self._rail and isinstance(result, Name):
                self._conditional.add(result.name)
        self._when(block.at, power, *body)

    def _result(
        self, block: LadderBlock, pin: Pin, value: Expression, into: list[Statement]
    ) -> Expression:
        """Store a result in the operands right of it; return it for what else it leads to."""
        targets, is_all = self._targets(pin.row, block.column + 1)
        if len(targets) == 1 and is_all:
            into.append(Assignment(targets[0].at, self._operand(targets[0]), value))
            return value
        result = self._temporary(pin.at, value, into)
        into += [Assignment(each.at, self._operand(each), result) for each in targets]
        return result

    def _targets(self, row: int, edge: int) -> tuple[Sequence[Cell], bool]:
        """Return the analog operands right of an edge, and whether nothing else follows them."""
        found: list[Cell] = []
        while len(self._joined(row, edge)) == 1:
            cell = self._cell(row, edge)
            if cell is None or cell.kind == "empty":
                return found, True
            if cell.kind == "analog":
                found.append(cell)
                self._stored.add((row, edge))
            elif cell.kind != "line":
                break
            edge += 1
        return found, False

    # Operands

    def _operand(self, cell: Cell) -> Expression:
        return self._parser.operand(cell.at) or Name(cell.at, cell.name)

    def _fail(self, at: int, message: str) -> None:
        offset = self._parser.tokens.offset(at)
        self._parser.diagnostics.error(offset, f"network {self._network.number}: {message}")
