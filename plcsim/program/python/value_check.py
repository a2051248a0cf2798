"""What a variable of a program cannot take, as far as the source tells: a text for a BOOL.

ctypes refuses most of it too, but in the cycle that gets there, and in its own words; a BOOL it
gives the truth of whatever comes. What cannot be known from the source is not judged.
"""

from __future__ import annotations

import ast
import builtins
from typing import TYPE_CHECKING, Any, Final

from plcsim.program.python.shared import ConstantAttribute, GlobalVariable
from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    ReferenceType,
    StringType,
    StructType,
    SubrangeType,
    WStringType,
    resolve_alias,
)
from st_types.types.elementary import TIME, ElementaryType, Kind

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from st_types import Struct
    from st_types.types.elementary import DataType

NUMBERS: Final = frozenset([bool, int, float])

LONGEST_SOURCE: Final = 40
"""Characters of the source of a value that are shown."""

_CONVERSIONS: Final = {"bool": bool, "float": float, "int": int, "len": int, "str": str}

_LITERALS: Final[Mapping[type[ast.expr], type]] = {
    ast.JoinedStr: str,
    ast.List: list,
    ast.ListComp: list,
    ast.Tuple: tuple,
    ast.Dict: dict,
    ast.DictComp: dict,
    ast.Set: set,
    ast.SetComp: set,
    ast.Compare: bool,
}


def taken_by(data_type: DataType[Any]) -> frozenset[type]:
    """Return the Python types of the values that a variable takes."""
    match resolve_alias(data_type):
        case ElementaryType(kind=Kind.REAL):
            return NUMBERS
        case ElementaryType() | SubrangeType() | ReferenceType() | EnumerationType():
            return frozenset([bool, int])
        case StringType():
            return frozenset([str, bytes])
        case WStringType():
            return frozenset([str])
        case ArrayType():
            return frozenset([list, tuple, bytes])
        case StructType():
            return frozenset([dict])
    return frozenset()


def values_of(data_type: DataType[Any]) -> type | None:
    """Return the Python type of the values that are read from a variable, None for a view."""
    match resolve_alias(data_type):
        case ElementaryType(kind=Kind.BOOL):
            return bool
        case ElementaryType(kind=Kind.REAL):
            return float
        case StringType() | WStringType():
            return str
        case ArrayType() | StructType():
            return None
    return int


class ValueCheck:
    """Judges what is stored in the variables of one class.

    Args:
        view: the class.
        name: of its first parameter, ``self``.
        names: that the module has.
    """

    def __init__(self, view: type[Struct], name: str, names: Mapping[str, object]) -> None:
        self._view = view
        self._name = name
        self._names = names

    def findings(self, node: ast.AST) -> Iterator[str]:
        """Iterate over what is wrong in a statement or a call, but not in what is inside it."""
        match node:
            case ast.Assign(targets=targets, value=value):
                for target in targets:
                    yield from self._store(target, value)
            case ast.AnnAssign(target=target, value=ast.expr() as value):
                yield from self._store(target, value)
            case ast.AugAssign(target=target, op=op, value=value):
                yield from self._store(target, ast.BinOp(target, op, value))
            case ast.Call(func=called, keywords=keywords):
                block = self.type_of(called)
                for keyword in keywords:
                    data_type = _member(block, keyword.arg or "")
                    target = ast.Attribute(called, keyword.arg or "", ast.Store())
                    yield from self._judge(target, data_type, keyword.value)

    def type_of(self, node: ast.expr) -> DataType[Any] | None:
        """Return the type of the variable that an expression names, None where it names none."""
        match node:
            case ast.Attribute(value=ast.Name(id=name), attr=attribute) if name == self._name:
                return self._own(attribute)
            case ast.Attribute(value=inner, attr=attribute):
                return _member(self.type_of(inner), attribute)
            case ast.Subscript(value=inner, slice=index) if not isinstance(index, ast.Slice):
                array = self.type_of(inner)
                return resolve_alias(array.element) if isinstance(array, ArrayType) else None
        return None

    def _own(self, name: str) -> DataType[Any] | None:
        """Return the type of ``self.name``."""
        found = vars(self._view).get(name) or getattr(self._view, name, None)
        if isinstance(found, GlobalVariable | ConstantAttribute) and found.data_type is not None:
            return resolve_alias(found.data_type)
        return _member(self._view._plc_type, name)

    def _store(self, target: ast.expr, value: ast.expr) -> Iterator[str]:
        if isinstance(target, ast.Tuple | ast.List) and isinstance(value, ast.Tuple | ast.List):
            if len(target.elts) == len(value.elts):
                for one, other in zip(target.elts, value.elts, strict=True):
                    yield from self._store(one, other)
            return
        yield from self._judge(target, self.type_of(target), value)

    def _judge(
        self, target: ast.expr, data_type: DataType[Any] | None, value: ast.expr
    ) -> Iterator[str]:
        """Tell what is wrong with a value for a variable of a type."""
        given = None if data_type is None else self._sort_of(value)
        if data_type is None or given is None:
            return
        if given not in taken_by(data_type) or _is_no_bool(data_type, value):
            yield f"{_shown(target)} is {data_type} and cannot be {_shown(value)}" + _hint(
                data_type, given, value
            )

    def _sort_of(self, node: ast.expr) -> type | None:
        """Return the Python type of an expression, None where the source does not tell."""
        match node:
            case ast.Constant(value=value):
                return type(value)
            case ast.UnaryOp(op=ast.Not()):
                return bool
            case ast.UnaryOp(operand=operand):
                sort = self._sort_of(operand)
                return int if sort is bool else sort if sort in NUMBERS else None
            case ast.BinOp(left=left, op=op, right=right):
                return _result(op, self._sort_of(left), self._sort_of(right))
            case ast.IfExp(body=body, orelse=other):
                sort = self._sort_of(body)
                return sort if sort is self._sort_of(other) else None
            case ast.Call(func=ast.Name(id=name)) if name in _CONVERSIONS:
                known = self._names.get(name, getattr(builtins, name))
                return _CONVERSIONS[name] if known is getattr(builtins, name) else None
            case ast.Attribute() | ast.Subscript():
                data_type = self.type_of(node)
                return None if data_type is None else values_of(data_type)
        return _LITERALS.get(type(node))


def _member(data_type: DataType[Any] | None, name: str) -> DataType[Any] | None:
    if isinstance(data_type, StructType) and data_type.spelling(name) == name:
        return resolve_alias(data_type.find(name)[0].data_type)
    return None


def _result(operator: ast.operator, left: type | None, right: type | None) -> type | None:
    """Return the type that an operator makes of two."""
    if left is str and (isinstance(operator, ast.Mod) or right is str):
        return str
    if left not in NUMBERS or right not in NUMBERS or isinstance(operator, ast.Pow):
        return None
    if isinstance(operator, ast.Div) or float in (left, right):
        return float
    is_bits = isinstance(operator, ast.BitAnd | ast.BitOr | ast.BitXor)
    return bool if is_bits and left is right is bool else int


def _is_no_bool(data_type: DataType[Any], value: ast.expr) -> bool:
    """Whether a BOOL is to be a number other than 0 and 1."""
    is_number = isinstance(value, ast.Constant) and value.value not in (0, 1)
    return is_number and values_of(data_type) is bool


def _hint(data_type: DataType[Any], given: type, value: ast.expr) -> str:
    if data_type is TIME and given is str:
        return f"; a TIME is a number of milliseconds, which T({_shown(value)}) gives"
    if given is float and values_of(data_type) is int:
        return "; // divides without a fraction, int(...) cuts one off"
    return ""


def _shown(node: ast.expr) -> str:
    text = ast.unparse(node)
    return text if len(text) <= LONGEST_SOURCE else f"{text[:LONGEST_SOURCE]}..."
