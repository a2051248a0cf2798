"""Which texts are WSTRINGs: standard files call one function for STRINGs and for WSTRINGs.

This is known of an expression before it is checked: checking it twice would take time with the
power of the depth of calls in calls.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.program.structured_text.check.builtins import conversion_of
from plcsim.program.structured_text.check.kinds import TypeKind, kind_of, plain
from plcsim.program.structured_text.check.standard_names import STRING_FUNCTIONS
from st_types.syntax import expressions as syntax
from st_types.types.derived import ArrayType, ReferenceType, StructType, WStringType

if TYPE_CHECKING:
    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.names import ScopeNames
    from st_types.syntax.expressions import Expression


def function_for(name: str, node: syntax.Call, names: ScopeNames) -> str:
    """Return the string function that a call of ``name`` means: of WSTRINGs the library iec's."""
    return f"W{name}" if is_wide(node, names) else name


def is_wide(node: Expression, names: ScopeNames) -> bool:
    """Return whether an expression is a WSTRING; calls of string functions are as their texts."""
    waiting: list[Expression] = [node]
    while waiting:
        node = waiting.pop()
        if type(node) is syntax.Literal:
            if node.constant.type_name == "WSTRING":
                return True
        elif type(node) is not syntax.Call:
            found = _type_of(node, names)
            if found is not None and kind_of(found) is TypeKind.WSTRING:
                return True
        elif type(node.function) is syntax.Name:
            name = node.function.name.upper()
            if name in STRING_FUNCTIONS or name in ("SEL", "MUX", "MAX", "MIN", "LIMIT", "MOVE"):
                waiting += [each.value for each in node.arguments if each.value is not None]
            elif _gives_wide(node.function.name, names):
                return True
    return False


def _gives_wide(name: str, names: ScopeNames) -> bool:
    found = conversion_of(name)
    if found is not None:
        return isinstance(found[1], WStringType)
    function = names.scope.find_function(name)
    result = None if function is None else function.result
    return result is not None and isinstance(plain(result), WStringType)


def _type_of(node: Expression, names: ScopeNames) -> Type | None:
    """Return the type of a variable, a member, an element or what a pointer leads to."""
    if type(node) is syntax.Name:
        value = names.value(node)
        return None if value is None else value.type
    if type(node) is syntax.MemberAccess:
        base = _type_of(node.base, names)
        if not isinstance(base, StructType):
            return None
        spelling = base.spelling(node.name)
        return None if spelling is None else plain(base.find(spelling)[0].data_type)
    if type(node) is syntax.Index:
        base = _type_of(node.base, names)
        return plain(base.element) if isinstance(base, ArrayType) else None
    if type(node) is syntax.Dereference:
        base = _type_of(node.base, names)
        target = base.target if isinstance(base, ReferenceType) else None
        return None if target is None else plain(target)
    return None
