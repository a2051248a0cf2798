"""Constants and initial values of one file, with the findings they give rise to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from st_types.resolve.constant_lookup import ConstantLookup
from st_types.resolve.constants import EvaluationError, NotConstantError, evaluate
from st_types.resolve.initial_values import MAX_ELEMENTS, initial_value
from st_types.syntax.expressions import Literal
from st_types.syntax.literals import Constant

if TYPE_CHECKING:
    from collections.abc import Mapping

    from st_types.resolve.scope import Scope
    from st_types.syntax.expressions import Expression, Node
    from st_types.syntax.tree import Declaration, DeclarationFile
    from st_types.types.derived import EnumerationType
    from st_types.types.elementary import DataType


class ConstantResolver(ConstantLookup):
    """Works out constant expressions in one file.

    Attributes:
        file: takes the findings.
        values: values so far of the enumeration at hand, by `Dialect.key`.
    """

    def __init__(self, scope: Scope, file: DeclarationFile) -> None:
        super().__init__(scope)
        self.file = file
        self.values: Mapping[str, int] = {}
        self._expected: EnumerationType[object] | None = None
        self._elements_left = MAX_ELEMENTS

    def error(self, node: Node | int, message: str, hint: str = "") -> None:
        """Record an error at a node or a token."""
        self.file.error(node, message, hint)

    def warning(self, node: Node | int, message: str, hint: str = "") -> None:
        """Record a warning at a node or a token."""
        self.file.warning(node, message, hint)

    def missing(self, node: Node | int, message: str, hint: str = "") -> None:
        """Record that a name is not here: a warning, unless the scope is strict."""
        (self.error if self.scope.strict else self.warning)(node, message, hint)

    def check_spelling(self, declared: str, name: str, at: int) -> None:
        """Warn if ``name`` is declared in another case and the dialect minds."""
        if declared != name and self.scope.dialect.case_sensitive:
            self.warning(at, f"{name} is declared as {declared}; names differ in case")

    def constant(self, name: str, at: int) -> Constant | None:
        """Return the value of a constant or of an enumeration; see `Constants`.

        The values of the enumeration at hand, and of the one that is expected, come first.
        """
        key = self.scope.dialect.key(name)
        if key in self.values:
            return Constant("DINT", self.values[key])
        if self._expected is not None:
            is_exact = self.scope.dialect.case_sensitive
            declared = name if is_exact else self._expected.spelling(name)
            if declared in self._expected.values:
                return Constant(self._expected.name, self._expected.values[declared])
        return super().constant(name, at)

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
        level, outer, self._expected = self.level, self._expected, enumeration
        try:
            return evaluate(node, self)
        except EvaluationError as err:
            self._report(err)
            return None
        finally:
            self.level, self._expected = level, outer

    def _report(self, err: EvaluationError) -> None:
        if err.unknown_name:
            self.missing(err.at, err.message, self.scope.hint("constants", err.unknown_name))
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
