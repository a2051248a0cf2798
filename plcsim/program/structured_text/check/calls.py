"""Checking calls: built-in functions, functions with a declaration, function blocks."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.program.structured_text.check import builtins
from plcsim.program.structured_text.check.fits import are_alike
from plcsim.program.structured_text.check.kinds import (
    ANY_INT,
    BOOL,
    DINT,
    UDINT,
    VOID,
    kind_of,
    plain,
)
from plcsim.program.structured_text.check.methods import MethodChecker
from plcsim.program.structured_text.check.names import BY_ADDRESS, NOTHING, keep_address
from plcsim.program.structured_text.check.open_arrays import parameters
from plcsim.program.structured_text.check.standard_names import STRING_FUNCTIONS, standard_parameter
from plcsim.program.structured_text.check.texts import function_for
from plcsim.program.structured_text.check.typed import (
    PLACES,
    Address,
    Bit,
    Call,
    Compare,
    Constant,
    Edge,
    Symbol,
    Target,
    Variable,
)
from plcsim.program.structured_text.codes import FindingCode
from st_types.syntax import expressions as syntax
from st_types.syntax.tree import OpenArraySpecification
from st_types.types.derived import ArrayType, DataBlockType, ReferenceType

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plcsim.program.structured_text.check.classes import ClassMethod
    from plcsim.program.structured_text.check.findings import FileFindings
    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.methods import Callees
    from plcsim.program.structured_text.check.names import ScopeNames
    from plcsim.program.structured_text.check.open_arrays import OpenFunction
    from plcsim.program.structured_text.check.typed import Value
    from st_types.resolve.declared import DeclaredFunction, DeclaredFunctionBlock
    from st_types.syntax.expressions import Expression
    from st_types.syntax.tree import Declaration

_INPUTS: Final = frozenset(["VAR_INPUT", "VAR_IN_OUT"])
_OF_CODESYS: Final = frozenset(
    [
        *("__NEW", "__DELETE", "__QUERYINTERFACE", "__QUERYPOINTER", "__VARINFO", "__POSITION"),
        *("BITADR", "INDEXOF", "TEST_AND_SET", "__XADD"),
    ]
)
"""Functions that are known by name and not supported."""

_PARAMETERS: Final = frozenset(["VAR_INPUT", "VAR_IN_OUT", "VAR_OUTPUT"])


class Parameter(NamedTuple):
    """A parameter of a function.

    Attributes:
        name: as declared.
        type: plain; None for ANY_NUM and the like, which take the value's own.
        section: VAR_INPUT, VAR_IN_OUT or VAR_OUTPUT.
        by_address: the address of a place goes over.
        is_optional: it has an initial value.
        initial: that value, None for that of the type.
    """

    name: str
    type: Type | None
    section: str
    by_address: bool
    is_optional: bool = False
    initial: object = None


def parameters_of(function: DeclaredFunction) -> tuple[Parameter, ...]:
    """Return the parameters of a function in order."""
    found = []
    for variable in function.variables:
        section = variable.block.section
        if section in _PARAMETERS and not variable.is_constant:
            data_type = None if variable.data_type is None else plain(variable.data_type)
            by_address = section != "VAR_INPUT" or (
                data_type is not None and kind_of(data_type) in BY_ADDRESS
            )
            has_initial = variable.node.initial is not None
            parameter = Parameter(variable.name, data_type, section, by_address, has_initial)
            found.append(parameter._replace(initial=variable.initial))
    return tuple(found)


class CallChecker(MethodChecker):
    """Checks calls.

    Attributes:
        edges: how many edge functions were met in the function block, for its zzEdge members.
        texts_are_addresses: a text that goes into a UDINT is its address.
        called_open: functions and function blocks that take arrays of any bounds, by the names of
            what was made of them for their calls.
    """

    edges = 0
    texts_are_addresses = False

    def __init__(self, names: ScopeNames, findings: FileFindings) -> None:
        super().__init__(names, findings)
        self.called_open: dict[str, tuple[OpenFunction, DeclaredFunction | DeclaredFunctionBlock]]
        self.called_open = {}

    def _call(self, node: syntax.Call) -> Value:
        found = self.called(node)
        if type(found) is Call and found.type is VOID and found.function.node.result is None:
            message = f"{found.function.name} gives no value"
            self.error(node, FindingCode.NO_VALUE, message)
        return found

    def called(self, node: syntax.Call) -> Value:
        """Check a call; it may give nothing."""
        name = node.function
        found = self.method_of(name)
        if found is not None:
            found = self._for_bounds(node, found)
            if found is None:
                return NOTHING
            return self.call_by(found, lambda method: self.arguments_of(node, method.function))
        if type(name) is syntax.MemberAccess and self.is_namespace(name.base):
            name = syntax.Name(name.at, name.name)
            node = syntax.Call(node.at, name, node.arguments)
        if type(name) is not syntax.Name:
            return self._not_callable(node)
        upper = name.name.upper()
        if upper == "TIME" and not node.arguments:
            name = syntax.Name(name.at, "clock_ms")  # of CODESYS: time since the start
        if upper in builtins.PLACE_FUNCTIONS:
            return self._place_function(node, upper)
        if upper in builtins.EDGES:
            return self._edge(node, upper)
        if upper in builtins.BOUNDS and not self.names.scope.dialect.case_sensitive:
            return self._bound(node, upper)
        rule = builtins.rule_of(name.name)
        own = self.names.symbols.own_functions
        if rule is not None and (not own or self.names.scope.dialect.key(name.name) not in own):
            return self._builtin(node, upper, rule)
        return self._declared(node, name)

    def is_namespace(self, node: Expression) -> bool:
        """Return whether an expression is the name of a namespace."""
        if type(node) is not syntax.Name or self.names.value(node) is not None:
            return False
        return self.names.is_namespace(node.name)

    def _not_callable(self, node: syntax.Call) -> Value:
        value = self.value(node.function)
        if isinstance(value.type, DataBlockType):
            message = f"{value.type} is a function block; its call is a statement and has no value"
            self.error(node, FindingCode.NO_VALUE, message)
        elif value.type is not VOID:
            self.error(node, FindingCode.NOT_CALLABLE, f"{value.type} cannot be called")
        return NOTHING

    # Functions of a place

    def _place_function(self, node: syntax.Call, name: str) -> Value:
        if len(node.arguments) != 1 or node.arguments[0].value is None:
            self.error(node, FindingCode.WRONG_ARGUMENTS, f"{name} takes 1 argument")
            return NOTHING
        argument = node.arguments[0].value
        if name == "__ISVALIDREF":
            return self._leads_somewhere(argument)
        return self._size(argument) if name == "SIZEOF" else self.address(argument)

    def _leads_somewhere(self, node: Expression) -> Value:
        """Check ``__ISVALIDREF(reference)`` of CODESYS."""
        value = self.value(node)
        pointer = value.pointer if isinstance(value, Target) else value
        if not isinstance(pointer.type, ReferenceType):
            if value.type is not VOID:
                self.error(node, FindingCode.NO_REFERENCE, f"{value.type} is no reference")
            return NOTHING
        return Compare(BOOL, "<>", UDINT, pointer, Constant(UDINT, 0))

    def _size(self, node: Expression) -> Value:
        if type(node) is syntax.Name and self.names.value(node) is None:
            data_type = self.names.scope.find_type(node.name)
            if data_type is not None:
                return Constant(ANY_INT, data_type.size)
        if isinstance(node, syntax.Literal) and isinstance(node.constant.value, str):
            return Constant(ANY_INT, len(node.constant.value) + 1)
        value = self.value(node)
        if value.type is not VOID and (isinstance(value, Bit) or not isinstance(value, PLACES)):
            self.error(node, FindingCode.NO_ADDRESS, "SIZEOF takes a variable or a type")
        return Constant(ANY_INT, value.type.size)

    def address(self, node: Expression) -> Value:
        """Return the address of a place, a constant, or of a string that is written there."""
        constant = self.names.constant(node) if type(node) is syntax.Name else None
        value = constant or self.value(node)
        if isinstance(value, Constant) and isinstance(value.value, str):
            return Address(UDINT, value)
        if value.type is VOID:
            return NOTHING
        if isinstance(value, Bit) or not isinstance(value, PLACES):
            self.error(node, FindingCode.NO_ADDRESS, "this has no address")
            return NOTHING
        keep_address(value)
        return Address(UDINT, value)

    def _bound(self, node: syntax.Call, name: str) -> Value:
        """Check ``LOWER_BOUND(array, dimension)``: the bounds of all arrays are known here."""
        values = [self.value(each.value) for each in node.arguments if each.value is not None]
        if any(value.type is VOID for value in values):
            return NOTHING
        array = values[0].type if values else VOID
        number = values[1].value if len(values) == 2 and isinstance(values[1], Constant) else None
        if not isinstance(array, ArrayType) or not isinstance(number, int):
            message = f"{name} takes an array and the number of a dimension"
            self.error(node, FindingCode.WRONG_ARGUMENTS, message)
            return NOTHING
        if not 1 <= number <= len(array.bounds):
            message = f"{array} has no dimension {number}"
            self.error(node, FindingCode.INDEX_OUTSIDE, message)
            return NOTHING
        return Constant(DINT, array.bounds[number - 1][name == "UPPER_BOUND"])

    # Edges

    def _edge(self, node: syntax.Call, name: str) -> Value:
        if len(node.arguments) != 1 or node.arguments[0].value is None:
            self.error(node, FindingCode.WRONG_ARGUMENTS, f"{name} takes 1 argument")
            return NOTHING
        argument = node.arguments[0].value
        value = self.value(argument)
        self.check_fit(argument, value, BOOL)
        return Edge(BOOL, name, value, self._edge_memory(node))

    def _edge_memory(self, node: syntax.Call) -> Value:
        """Return the variable that remembers the value: of a function block a member of its own.

        Automation Studio declares such members itself, zzEdge00000 and so on, in order of the text.
        """
        number = self.edges
        self.edges += 1
        if self.names.symbols.storages.get(self.names.scope) == "instance":
            name = f"zzEdge{number:05}"
            found = self.names.value(syntax.Name(node.at, name))
            if found is None:
                message = f"the function block has no member {name} for this edge"
                hint = "declare it as VAR : BOOL, as Automation Studio does when it builds"
                self.error(node, FindingCode.UNKNOWN_MEMBER, message, hint)
            return found or NOTHING
        return Variable(BOOL, Symbol(f"edge {number}", BOOL, "hidden"))

    # Built-in functions

    def _builtin(self, node: syntax.Call, name: str, rule: builtins.Rule) -> Value:
        nodes = self._arguments_in_order(node, name, rule)
        if nodes is None:
            return NOTHING
        values = [self.value(each) for each in nodes]
        if any(value.type is VOID for value in values):
            return NOTHING
        found = rule.made(name, values)
        if found is None:
            types = ", ".join(str(value.type) for value in values)
            self.error(node, FindingCode.WRONG_OPERANDS, f"{name} does not take {types}")
            return NOTHING
        return found

    def _arguments_in_order(
        self, node: syntax.Call, name: str, rule: builtins.Rule
    ) -> list[Expression] | None:
        found: list[Expression] = []
        named: dict[int, Expression] = {}
        for argument in node.arguments:
            if argument.value is None or argument.is_output:
                self.error(argument, FindingCode.WRONG_ARGUMENTS, f"{name} takes values only")
                return None
            if not argument.name:
                found.append(argument.value)
                continue
            place = _place_of(argument.name.upper(), rule)
            if place is None or place in named:
                message = f"{name} has no parameter {argument.name}"
                self.error(argument, FindingCode.UNKNOWN_PARAMETER, message)
                return None
            named[place] = argument.value
        if named:
            found += [named[place] for place in sorted(named)]
        if not rule.least <= len(found) <= rule.most:
            wanted = (
                _count(rule.least) if rule.least == rule.most else f"{rule.least} or more arguments"
            )
            message = f"{name} takes {wanted}, not {len(found)}"
            self.error(node, FindingCode.WRONG_ARGUMENTS, message)
            return None
        return found

    # Declared functions

    def _declared(self, node: syntax.Call, name: syntax.Name) -> Value:
        scope = self.names.scope
        hit = scope.lookup("functions", name.name)
        function = None if hit is None else scope.find_function(name.name)
        if function is None or hit is None:
            found = self.names.symbols.open_functions.get(scope.dialect.key(name.name))
            return self._otherwise_known(node, name) if found is None else self._open(node, found)
        self.names.check_case(name, hit)
        if function.name in STRING_FUNCTIONS and not scope.dialect.case_sensitive:
            meant = function_for(function.name, node, self.names)
            function = scope.find_function(meant) or function
            if function.name in ("CONCAT", "WCONCAT"):
                node = _in_pairs(node)
        self.called_bodies.add(function.name)
        arguments = self.arguments_of(node, function)
        result = VOID if function.result is None else plain(function.result)
        if function.node.result is not None and function.result is None:
            self.error(node, FindingCode.UNKNOWN_TYPE, f"the type of {name.name} is not known")
        return Call(result, function, arguments)

    def _for_bounds(self, node: syntax.Call, found: Callees) -> Callees | None:
        """Return the methods for the bounds of what they are given, None after an error."""
        methods: dict[int, ClassMethod] = {}
        for number, method in found.methods.items():
            made: ClassMethod | None = method
            if method.open is not None:
                arrays = self.arrays_given(node, method.open)
                made = None if arrays is None else method.made_for(arrays)
            if made is None:
                return None
            methods[number] = made
        return found._replace(methods=methods)

    def _open(self, node: syntax.Call, open_function: OpenFunction) -> Value:
        """Check the call of a function that takes arrays of any bounds."""
        arrays = self.arrays_given(node, open_function)
        function = None if arrays is None else open_function.made_for(arrays)
        if function is None:
            return NOTHING  # what is wrong was told
        self.called_open[function.name] = (open_function, function)
        self.called_bodies.add(function.name)
        arguments = self.arguments_of(node, function)
        result = VOID if function.result is None else plain(function.result)
        return Call(result, function, arguments)

    def arrays_given(
        self, node: syntax.Call, open_function: OpenFunction
    ) -> dict[str, ArrayType[object]] | None:
        """Return what a call gives for parameters ARRAY[*], by their names; None after an error."""
        arrays: dict[str, ArrayType[object]] = {}
        for each, specification, argument in self._for_open_arrays(node, open_function):
            given = None if argument is None else argument.value
            data_type = None if given is None else self.value(given).type
            count = specification.dimensions
            if not isinstance(data_type, ArrayType) or len(data_type.bounds) != count:
                if data_type is not VOID:
                    dimensions = f"{count} dimension{'' if count == 1 else 's'}"
                    message = f"{each.name} takes an array of {dimensions}"
                    self.error(argument or node, FindingCode.WRONG_ARGUMENTS, message)
                return None
            arrays[each.name] = data_type
        return arrays

    def _for_open_arrays(
        self, node: syntax.Call, open_function: OpenFunction
    ) -> Iterator[tuple[Declaration, OpenArraySpecification, syntax.Argument | None]]:
        """Yield the parameters that are ARRAY[*], each with what the call gives for it."""
        key_of = self.names.scope.dialect.key
        named = {key_of(each.name): each for each in node.arguments if each.name}
        unnamed = [each for each in node.arguments if not each.name]
        for place, each in enumerate(parameters(open_function.unit.declaration)):
            specification = each.specification
            if isinstance(specification, OpenArraySpecification):
                by_place = unnamed[place] if place < len(unnamed) else None
                yield each, specification, named.get(key_of(each.name), by_place)

    def _otherwise_known(self, node: syntax.Call, name: syntax.Name) -> Value:
        """Check ``ADD_INT(a, b)`` and the like, which the norm has beside ``ADD(a, b)``."""
        is_standard = not self.names.scope.dialect.case_sensitive
        rule = builtins.typed_rule(name.name) if is_standard else None
        if rule is None:
            return self._no_function(node, name)
        return self._builtin(node, name.name.upper(), rule)

    def _no_function(self, node: syntax.Call, name: syntax.Name) -> Value:
        if self.names.value(name) is not None:
            return self._not_callable(node)
        scope = self.names.scope
        if scope.find_function_block(name.name) is not None:
            message = f"{name.name} is a function block; an instance of it can be called"
            self.error(
                node, FindingCode.NOT_CALLABLE, message, f"declare x : {name.name}; then x()"
            )
            return NOTHING
        if name.name.upper() in _OF_CODESYS and not scope.dialect.case_sensitive:
            self.error(node, FindingCode.NOT_SUPPORTED, f"{name.name} is not supported")
            return NOTHING
        known = (each for outer in scope.chain for each in outer.index.names("functions"))
        message = f"no function is called {name.name}{self.findings.near(name.name, known)}"
        self.error(node, FindingCode.UNKNOWN_NAME, message, scope.hint("functions", name.name))
        for argument in node.arguments:
            if argument.value is not None:
                self.value(argument.value)
        return NOTHING

    def arguments_of(self, node: syntax.Call, function: DeclaredFunction) -> list[Value | None]:
        """Return the arguments in the order of the parameters, each checked against its own."""
        parameters = parameters_of(function)
        given = self._given(node, function.name, parameters)
        found: list[Value | None] = []
        for parameter in parameters:
            argument = given.get(parameter.name)
            if argument is not None and argument.value is not None:
                found.append(self._argument(argument.value, parameter))
                continue
            found.append(None)
            is_needed = parameter.section in _INPUTS and not parameter.is_optional
            if is_needed and not given.get("", None):
                message = f"{function.name} needs a value for {parameter.name}"
                self.error(node, FindingCode.WRONG_ARGUMENTS, message)
        return found

    def _given(
        self, node: syntax.Call, name: str, parameters: Sequence[Parameter]
    ) -> dict[str, syntax.Argument]:
        """Return the arguments by the names of their parameters."""
        found: dict[str, syntax.Argument] = {}
        key_of = self.names.scope.dialect.key
        spellings = {key_of(each.name): each.name for each in parameters}
        for place, argument in enumerate(node.arguments):
            if argument.name:
                key = spellings.get(key_of(argument.name)) or standard_parameter(
                    name, argument.name, spellings.values()
                )
            else:
                key = parameters[place].name if place < len(parameters) else None
            if key is None:
                self._no_parameter(argument, name, parameters)
            elif key in found:
                self.error(argument, FindingCode.WRONG_ARGUMENTS, f"{key} is given twice")
            else:
                found[key] = argument
        return found

    def _no_parameter(
        self, argument: syntax.Argument, name: str, parameters: Sequence[Parameter]
    ) -> None:
        if argument.name:
            near = self.findings.near(argument.name, (each.name for each in parameters))
            message = f"{name} has no parameter {argument.name}{near}"
            self.error(argument, FindingCode.UNKNOWN_PARAMETER, message)
        else:
            message = f"{name} takes {_count(len(parameters))}"
            self.error(argument, FindingCode.WRONG_ARGUMENTS, message)
        if argument.value is not None:
            self.value(argument.value)

    def _argument(self, node: Expression, parameter: Parameter) -> Value:
        value = self.value(node)
        target = parameter.type
        if value.type is VOID or target is None:
            return value
        value = self.as_implementation(self.address_of_text(node, value, target), target)
        if isinstance(target, ReferenceType):
            return self._reference_argument(node, value, target)
        if not parameter.by_address:
            self.check_fit(node, value, target)
            return value
        return self._address_argument(node, value, parameter, target)

    def address_of_text(self, node: Expression, value: Value, target: Type) -> Value:
        """Return the address of a text that goes into a UDINT where that is meant, else ``value``.

        Args:
            node: the value as it is written.
            value: of it.
            target: what it goes into.
        """
        is_text = isinstance(value, Constant) and isinstance(value.value, str)
        return (
            self.address(node)
            if self.texts_are_addresses and is_text and target is UDINT
            else value
        )

    def _reference_argument(self, node: Expression, value: Value, target: ReferenceType) -> Value:
        """Check what goes into a REFERENCE TO: an address, or a place of the type referred to."""
        lying = target.target
        if lying is None or isinstance(value, Address) or not are_alike(value.type, lying):
            self.check_fit(node, value, target)
            return value
        if isinstance(value, Target) and isinstance(value.pointer.type, ReferenceType):
            return value.pointer
        return self.address(node)

    def _address_argument(
        self, node: Expression, value: Value, parameter: Parameter, target: Type
    ) -> Value:
        if value.type is UDINT and isinstance(value, Address):
            return value  # ADR(x) for a STRING or a STRUCT, as Automation Studio lets it be
        self.check_fit(node, value, target)
        if parameter.section == "VAR_INPUT":
            is_place = isinstance(value, PLACES) and not isinstance(value, Bit)
            return Address(UDINT, value) if is_place else value
        if isinstance(value, Bit) or not isinstance(value, PLACES):
            message = f"{parameter.name} takes a variable"
            self.error(node, FindingCode.NO_VARIABLE, message)
            return NOTHING
        keep_address(value)
        return Address(UDINT, value)


def _in_pairs(node: syntax.Call) -> syntax.Call:
    """Return ``CONCAT(CONCAT(a, b), c)`` of ``CONCAT(a, b, c)``, which the norm has, too."""
    found = node
    if len(node.arguments) > 2:
        values = [replace(argument, name="") for argument in node.arguments]
        found = replace(node, arguments=values[:2])
        for value in values[2:]:
            inner = syntax.Argument(node.at, "", found)
            found = replace(node, arguments=[inner, value])
    return found


def _count(number: int) -> str:
    return f"{number} argument{'' if number == 1 else 's'}"


def _place_of(name: str, rule: builtins.Rule) -> int | None:
    """Return the place of a parameter; ``IN1``, ``IN2``, ... where any number is taken."""
    if name in rule.parameters:
        return rule.parameters.index(name)
    number = name.removeprefix("IN")
    if name.startswith("IN") and number.isdecimal() and rule.most == builtins.MANY:
        return len(rule.parameters) + int(number)
    return None
