"""Checking methods, properties and interfaces of function blocks."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from plcsim.program.structured_text.check.classes import BODY, GET, SET
from plcsim.program.structured_text.check.expressions import ExpressionChecker
from plcsim.program.structured_text.check.fits import as_character
from plcsim.program.structured_text.check.kinds import UDINT, VOID, plain
from plcsim.program.structured_text.check.names import NOTHING, keep_address
from plcsim.program.structured_text.check.typed import (
    PLACES,
    Constant,
    Dispatch,
    Implementation,
    Member,
    MethodCall,
    Target,
)
from plcsim.program.structured_text.codes import FindingCode
from st_types.syntax import expressions as syntax

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from plcsim.program.structured_text.check.classes import Class, ClassMethod
    from plcsim.program.structured_text.check.findings import FileFindings
    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.names import ScopeNames
    from plcsim.program.structured_text.check.typed import Value
    from st_types.resolve.declared import DeclaredFunction
    from st_types.syntax.expressions import Expression


class Callees(NamedTuple):
    """The methods that a call may mean.

    Attributes:
        value: the instance, or the variable of an interface.
        methods: by the number of the function block; 0 where only one is meant.
    """

    value: Value
    methods: Mapping[int, ClassMethod]


class MethodChecker(ExpressionChecker):
    """Checks what names a method or a property.

    Attributes:
        called_bodies: names of the functions, labels of the methods and blocks, that are called.
        called_methods: the methods that are called, by their labels.
    """

    def __init__(self, names: ScopeNames, findings: FileFindings) -> None:
        super().__init__(names, findings)
        self.called_bodies: set[str] = set()
        self.called_methods: dict[str, ClassMethod] = {}

    def arguments_of(self, node: syntax.Call, function: DeclaredFunction) -> Sequence[Value | None]:
        """Return the arguments in the order of the parameters."""
        raise NotImplementedError

    def method_of(self, node: Expression) -> Callees | None:
        """Return the methods that a call may mean, None where it is another call."""
        if not self.names.symbols.classes:
            return None
        key_of = self.names.scope.dialect.key
        if type(node) is syntax.Name:
            return self._methods(self.itself(), key_of(node.name)) if self.this else None
        if type(node) is syntax.Dereference and self._is_super(node):
            return self._of_super(BODY)
        if type(node) is not syntax.MemberAccess:
            return None
        if self._is_super(node.base):
            return self._of_super(key_of(node.name))
        if not self._may_have_methods(node.base):
            return None
        return self._methods(self.value(node.base), key_of(node.name))

    def _methods(self, value: Value, key: str) -> Callees | None:
        """Return the methods of this key that a value has, None where there is none."""
        symbols = self.names.symbols
        owner = symbols.classes.get(value.type)  # type: ignore[call-overload]  # any type is asked for
        if owner is not None:
            method = owner.find(key)
            return None if method is None else Callees(value, {0: method})
        interface = symbols.interfaces.get(value.type)
        if interface is None:
            return None
        numbered = self._implementing(interface.name)
        found = {number: each.find(key) for number, each in numbered.items()}
        methods = {number: method for number, method in found.items() if method is not None}
        return Callees(value, methods) if methods else None

    def _implementing(self, interface: str) -> dict[int, Class]:
        """Return the function blocks that implement an interface, by their numbers."""
        symbols = self.names.symbols
        known = {each.name.upper(): each for each in symbols.interfaces.values()}
        name = interface.upper()
        numbered = enumerate(symbols.classes.values(), 1)
        return {n: each for n, each in numbered if each.implements(name, known)}

    def as_implementation(self, value: Value, target: Type) -> Value:
        """Return what goes into a variable of an interface, or a character; else the value."""
        value = as_character(value, target)
        symbols = self.names.symbols
        interface = symbols.interfaces.get(target)
        if interface is None or value.type is target:
            return value
        if isinstance(value, Constant) and value.value == 0 and value.type is not VOID:
            return Implementation(target, None, 0)
        numbered = self._implementing(interface.name)
        number = next((n for n, each in numbered.items() if each.data_type is value.type), None)
        if number is None or not isinstance(value, PLACES):
            return value
        keep_address(value)
        return Implementation(target, value, number)

    def _may_have_methods(self, node: Expression) -> bool:
        """Return whether a path leads somewhere: what is no variable is told elsewhere."""
        while type(node) is not syntax.Name:
            if type(node) not in (syntax.MemberAccess, syntax.Index, syntax.Dereference):
                return False
            node = node.base  # type: ignore[union-attr]  # the three have it
        is_own = self.this is not None and node.name.upper() == "THIS"
        return is_own or self.names.value(node) is not None

    def _is_super(self, node: Expression) -> bool:
        if type(node) is syntax.Dereference:
            node = node.base
        return self.this is not None and type(node) is syntax.Name and node.name.upper() == "SUPER"

    def _of_super(self, key: str) -> Callees | None:
        base = None if self.maker is None else self.maker.base
        if base is None or self.this is None:
            return None
        method = self.this.find(key, base)
        return None if method is None else Callees(self.itself(), {0: method})

    def call_by(
        self, found: Callees, arguments: Callable[[ClassMethod], Sequence[Value | None]]
    ) -> Value:
        """Return the call of a method, or of one of several by the number in an interface."""
        value, methods = found
        if 0 in methods:
            return self._called_method(value, methods[0], arguments(methods[0]))
        pointer = Member(UDINT, value, 0)
        calls = [
            (n, self._called_method(Target(m.owner.data_type, pointer), m, arguments(m)))
            for n, m in methods.items()
        ]
        return Dispatch(calls[0][1].type, Member(UDINT, value, UDINT.size), calls)

    def _called_method(
        self, instance: Value, method: ClassMethod, arguments: Sequence[Value | None]
    ) -> MethodCall:
        self.called_methods[method.label] = method
        self.called_bodies.add(method.label)
        keep_address(instance)
        function = method.function
        result = VOID if function.result is None else plain(function.result)
        return MethodCall(result, function, arguments, instance, method.label)

    def read_property(self, node: syntax.Node, value: Value, name: str) -> Value | None:
        """Return what the GET of a property gives, None where there is no such property."""
        key = self.names.scope.dialect.key(name)
        found = self._methods(value, key + GET)
        if found is not None:
            return self.call_by(found, lambda _method: ())
        if self._methods(value, key + SET) is not None:
            self.error(node, FindingCode.NO_VALUE, f"the PROPERTY {name} has no GET")
            return NOTHING
        return None

    def written_property(self, node: Expression, value: Expression) -> Value | None:
        """Return the call of the SET of a property, None where ``node`` is no property."""
        if not self.names.symbols.classes:
            return None
        if type(node) is syntax.MemberAccess and self._may_have_methods(node.base):
            instance, name = self.value(node.base), node.name
        elif type(node) is syntax.Name and self.this is not None:
            if self.names.value(node) is not None:
                return None
            instance, name = self.itself(), node.name
        else:
            return None
        found = self._methods(instance, self.names.scope.dialect.key(name) + SET)
        if found is None:
            return None
        call = syntax.Call(node.at, node, [syntax.Argument(node.at, "", value)])
        return self.call_by(found, lambda method: self.arguments_of(call, method.function))
