"""Constants and initial values of one file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from st_types.resolve.constants import EvaluationError, NotConstantError, ScopeError, evaluate
from st_types.resolve.initial_values import MAX_ELEMENTS, initial_value
from st_types.syntax.expressions import Literal
from st_types.syntax.literals import Constant
from st_types.syntax.tree import Declaration
from st_types.types.conversions import convert
from st_types.types.derived import EnumerationType, resolve_alias
from st_types.types.elementary import ElementaryType

if TYPE_CHECKING:
    from collections.abc import Mapping

    from st_types.resolve.name_index import Entry, SourceFile
    from st_types.resolve.table import TypeTable
    from st_types.syntax.expressions import Expression, Node
    from st_types.types.elementary import DataType

MAX_NESTING = 50
"""Most types that lie one inside the other, and most constants that depend one on the other."""


class ConstantResolver:
    """Works out constant expressions in one file; it is the `Scope` of their names.

    Attributes:
        table: all declarations.
        owner: the file.
        local: constants that only the declarations at hand see, by name in capitals.
        values: values so far of the enumeration at hand.
    """

    def __init__(self, table: TypeTable, owner: SourceFile) -> None:
        self.table = table
        self.owner = owner
        self.local: dict[str, Constant | None] = {}
        self.values: Mapping[str, int] = {}
        self._expected: EnumerationType[object] | None = None
        self._elements_left = MAX_ELEMENTS

    def error(self, node: Node | int, message: str, hint: str = "") -> None:
        """Record an error at a node or a token."""
        self.owner.file.error(node, message, hint)

    def warning(self, node: Node | int, message: str, hint: str = "") -> None:
        """Record a warning at a node or a token."""
        self.owner.file.warning(node, message, hint)

    def missing(self, node: Node | int, message: str) -> None:
        """Record that a name is not here: a warning, unless the table is strict."""
        (self.error if self.table.strict else self.warning)(node, message)

    def constant(self, name: str) -> Constant | None:
        """Return the value of a constant or of an enumeration value; see `Scope`."""
        key = name.upper()
        if key in self.local:
            return _known(self.local[key])
        if name in self.values:
            return Constant("DINT", self.values[name])
        if self._expected is not None and name in self._expected.values:
            return Constant(self._expected.name, self._expected.values[name])
        entry = self.table.find("constants", name, self.owner)
        if entry is not None:
            return self._constant_value(entry)
        type_name, dot, value_name = name.rpartition(".")
        kind, wanted = ("types", type_name) if dot else ("enumeration_values", name)
        entry = self.table.find(kind, wanted, self.owner)
        return self._enumeration_value(entry, value_name.upper()) if entry is not None else None

    def _constant_value(self, entry: Entry) -> Constant:
        if entry.state == 1:
            raise ScopeError(f"{entry.node.name} depends on itself", is_final=True)
        self.check_open(entry)
        self.table.resolved(entry)
        assert isinstance(entry.node, Declaration)
        return _known(constant_of(entry.node, entry.data_type, entry.value))

    def _enumeration_value(self, entry: Entry, name: str) -> Constant | None:
        if entry.state == 1:
            return None
        data_type = self.table.resolved(entry).data_type
        if data_type is None:
            raise ScopeError
        data_type = resolve_alias(data_type)
        if not isinstance(data_type, EnumerationType):
            return None
        values = {key.upper(): value for key, value in data_type.values.items()}
        return Constant(data_type.name, values[name]) if name in values else None

    def check_open(self, entry: Entry) -> None:
        """Refuse to go deeper than `MAX_NESTING` declarations.

        Raises:
            ScopeError: ``entry`` would be one too many.
        """
        if entry.state == 0 and len(self.table.open) >= MAX_NESTING:
            message = f"more than {MAX_NESTING} declarations depend one on the other"
            raise ScopeError(message, is_final=True)

    def evaluate(
        self, node: Expression, enumeration: EnumerationType[object] | None = None
    ) -> Constant | None:
        """Return the value of a constant expression, None after a finding.

        Args:
            node: the expression.
            enumeration: its values are meant first.
        """
        if isinstance(node, Literal):
            return node.constant
        outer, self._expected = self._expected, enumeration
        try:
            return evaluate(node, self)
        except EvaluationError as err:
            self._report(err)
            return None
        finally:
            self._expected = outer

    def _report(self, err: EvaluationError) -> None:
        if err.unknown_name:
            self.missing(err.at, f"no constant is called {err.unknown_name} in the checked files")
        elif not isinstance(err, NotConstantError):
            self.error(err.at, err.message)
        elif err.message:
            self.missing(err.at, err.message)

    def integer(self, node: Expression) -> int | None:
        """Return the value of a constant integer expression, None after a finding."""
        constant = node.constant if type(node) is Literal else self.evaluate(node)
        if constant is None:
            return None
        if isinstance(constant.value, int):
            return int(constant.value)
        self.error(node, f"expected a whole number, found {constant.value!r}")
        return None

    def take_elements(self, count: int) -> bool:
        """Count elements of initial values; False if there are too many in this file."""
        self._elements_left -= count
        return self._elements_left >= 0

    def initial(self, node: Declaration, data_type: DataType[object] | None) -> object:
        """Return the initial value of a declaration, None for that of its type."""
        if node.initial is None or data_type is None:
            return None
        return initial_value(self, node.initial, data_type)


def constant_of(
    node: Declaration, data_type: DataType[object] | None, value: object
) -> Constant | None:
    """Return a declared constant as an operand; None for a list, a structure, an unknown value.

    A constant without a value is 0, as on the controller.
    """
    if node.initial is None and isinstance(data_type, ElementaryType):
        return Constant(data_type.name, convert(0, data_type))
    if data_type is None or not isinstance(value, bool | int | float | str):
        return None
    return Constant(data_type.name, value)


def _known(constant: Constant | None) -> Constant:
    if constant is None:
        raise ScopeError
    return constant
