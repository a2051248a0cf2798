"""Checking expressions: names to variables, operations to types."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.program.structured_text.check import operations
from plcsim.program.structured_text.check.fits import fit
from plcsim.program.structured_text.check.iec_check import IecCheck
from plcsim.program.structured_text.check.kinds import (
    ANY_INT,
    ANY_REAL,
    BOOL,
    DINT,
    UDINT,
    VOID,
    Fit,
    TypeKind,
    kind_of,
    number_type,
    plain,
)
from plcsim.program.structured_text.check.names import NOTHING, followed, keep_address
from plcsim.program.structured_text.check.standard_names import standard_name
from plcsim.program.structured_text.check.typed import (
    PLACES,
    Address,
    Binary,
    Bit,
    Constant,
    Element,
    Member,
    Target,
    This,
    Unary,
)
from plcsim.program.structured_text.codes import FindingCode
from st_types.syntax import expressions as syntax
from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    ReferenceType,
    StringType,
    StructType,
    WStringType,
)
from st_types.types.elementary import ALL_ELEMENTARY, BYTE, CHAR, DWORD, WCHAR, WORD

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.program.structured_text.check.classes import Class
    from plcsim.program.structured_text.check.findings import FileFindings
    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.names import ScopeNames
    from plcsim.program.structured_text.check.typed import Value
    from st_types.syntax.expressions import Expression

_PARTS: Final[dict[str, Type]] = {"B": BYTE, "W": WORD, "D": DWORD}
_LEAST, _BEYOND = -(1 << 63), 1 << 64
_LITERAL_TYPES: Final[dict[str, Type]] = {
    **ALL_ELEMENTARY,
    "ANY_INT": ANY_INT,
    "ANY_REAL": ANY_REAL,
}


class ExpressionChecker:
    """Checks the expressions of one body.

    Args:
        names: what names mean in it.
        findings: take what is wrong.

    Attributes:
        this: the function block that a body is compiled for, None for other bodies.
        maker: the function block in whose text it stands.
    """

    def __init__(self, names: ScopeNames, findings: FileFindings) -> None:
        self.names = names
        self.findings = findings
        self.error = findings.error
        self._checks = IecCheck(names)
        self._members: dict[tuple[Type, str], tuple[int, Type]] = {}
        self.this: Class | None = None
        self.maker: Class | None = None

    def value(self, node: Expression) -> Value:
        """Return the value of an expression; `NOTHING` after an error."""
        return _RULES[type(node)](self, node)

    def _name(self, node: syntax.Name) -> Value:
        found = self.names.values.get(node.name)
        if found is None:
            found = self.names.value(node)
        if found is None and self.this is not None:
            found = self._of_this(node)
        if found is None and node.name.upper() == "NULL" and self._is_standard:
            found = Constant(UDINT, 0)
        return self.unknown_name(node) if found is None else found

    @property
    def _is_standard(self) -> bool:
        return not self.names.scope.dialect.case_sensitive

    def _of_this(self, node: syntax.Name) -> Value | None:
        """Return what THIS, SUPER, or a property of the function block itself means."""
        if node.name.upper() in ("THIS", "SUPER"):
            return self.itself()
        return self.read_property(node, self.itself(), node.name)

    def itself(self) -> Value:
        """Return the data block that the body works on."""
        assert self.this is not None
        return Target(self.this.data_type, This(UDINT))

    def read_property(self, node: syntax.Node, value: Value, name: str) -> Value | None:
        """Return what the GET of a property gives, None where there is no such property."""
        raise NotImplementedError

    def unknown_name(self, node: syntax.Name) -> Value:
        """Tell that nothing has this name."""
        scope = self.names.scope
        if scope.lookup("types", node.name) or scope.lookup("functions", node.name):
            self.error(node, FindingCode.NO_VALUE, f"{node.name} has no value; it is no variable")
            return NOTHING
        known = (name for each in scope.chain[:2] for name in each.index.names("variables"))
        message = f"no variable is called {node.name}{self.findings.near(node.name, known)}"
        self.error(node, FindingCode.UNKNOWN_NAME, message, scope.hint("variables", node.name))
        return NOTHING

    def _literal(self, node: syntax.Literal) -> Value:
        constant = node.constant
        found = _LITERAL_TYPES.get(constant.type_name)
        if found is not None:
            value = constant.value
            if isinstance(value, int) and not _LEAST <= value < _BEYOND:
                self.error(
                    node, FindingCode.VALUE_OUTSIDE, f"{node.text[:40]} does not fit 64 bits"
                )
                return NOTHING
            return Constant(found, constant.value)
        text = str(constant.value)
        is_wide = constant.type_name == "WSTRING"
        return Constant(
            WStringType(len(text) or 1) if is_wide else StringType(len(text) or 1), text
        )

    def _address(self, node: syntax.DirectAddress) -> Value:
        found = self.names.located(node)
        if found is not None:
            return found
        hint = "declare a variable AT this address"
        if not self.names.scope.dialect.case_sensitive:
            hint = "%IX0.0, %QB1, %MW2, %MD3, %ML4 and the like are known, up to byte 65535"
        self.error(
            node, FindingCode.NOT_SUPPORTED, f"{node.text} in a statement is not supported", hint
        )
        return NOTHING

    # Paths

    def _member(self, node: syntax.MemberAccess) -> Value:
        base = node.base
        if type(base) is syntax.Name and self._is_no_value(base):
            return self._type_member(node, base)
        value = self.value(base)
        name = node.name
        found = self._members.get((value.type, name))
        if found is not None:
            return followed(Member(found[1], value, found[0]))
        data_type = value.type
        if isinstance(data_type, StructType):
            return self._struct_member(node, value, data_type)
        if data_type is VOID:
            return NOTHING
        if name.isdecimal():
            return self._bit(node, value, int(name))
        if name[0] == "%":
            return self._part(node, value)
        if kind_of(data_type) is TypeKind.INTEGER:
            if type(base) is syntax.Name and self._is_enumerator(base, name):
                return self._type_member(node, base)
            return self._named_bit(node, value)
        message = f"{data_type} has no members"
        self.error(node, FindingCode.NO_MEMBERS, message, _pointer_hint(data_type))
        return NOTHING

    def _is_enumerator(self, base: syntax.Name, name: str) -> bool:
        """Return whether ``color.red`` is a value of the type COLOR, beside a variable color."""
        if self.names.scope.dialect.case_sensitive:
            return False
        found = self.names.scope.find_type(base.name)
        enumeration = None if found is None else plain(found)
        return isinstance(enumeration, EnumerationType) and enumeration.spelling(name) is not None

    def _is_no_value(self, node: syntax.Name) -> bool:
        if self.names.value(node) is not None:
            return False
        return self.this is None or self._of_this(node) is None

    def _type_member(self, node: syntax.MemberAccess, base: syntax.Name) -> Value:
        """Check ``Type.value`` and ``Type#value`` of an enumeration."""
        if self.names.is_namespace(base.name):
            return self._name(syntax.Name(node.at, node.name))
        hit = self.names.scope.lookup("types", base.name)
        data_type = self.names.scope.find_type(base.name) if hit is not None else None
        if data_type is None or hit is None:
            return self.unknown_name(base)
        self.names.check_case(base, hit)
        enumeration = plain(data_type)
        if not isinstance(enumeration, EnumerationType):
            return self.unknown_name(base)
        spelling = enumeration.spelling(node.name)
        if spelling is None:
            near = self.findings.near(node.name, enumeration.values)
            message = f"{base.name} has no value {node.name}{near}"
            self.error(node, FindingCode.UNKNOWN_MEMBER, message)
            return NOTHING
        return Constant(enumeration, enumeration.values[spelling])

    def _struct_member(
        self, node: syntax.MemberAccess, value: Value, data_type: StructType[Any]
    ) -> Value:
        spelling = self.spelling_of(data_type, node.name)
        if spelling is None:
            read = self.read_property(node, value, node.name)
            if read is not None:
                return read
            near = self.findings.near(node.name, (member.name for member in data_type.members))
            message = f"{data_type} has no member {node.name}{near}"
            self.error(node, FindingCode.UNKNOWN_MEMBER, message)
            return NOTHING
        found = self.member_of(value, data_type, spelling)
        if spelling == node.name or not self.names.scope.dialect.case_sensitive:
            member, offset = data_type.find(spelling)
            self._members[data_type, node.name] = offset, plain(member.data_type)
        else:
            message = f"{node.name} is declared as {spelling}"
            self.findings.warning(node, FindingCode.OTHER_CASE, message)
        return found

    def spelling_of(self, data_type: StructType[Any], name: str) -> str | None:
        """Return how a member is declared; standard files know some by the norm's own names."""
        found = data_type.spelling(name)
        if found is None and not self.names.scope.dialect.case_sensitive:
            found = standard_name(data_type, name)
        return found

    def member_of(self, value: Value, data_type: StructType[Any], name: str) -> Value:
        """Return the member ``name`` of a structure, what it refers to if it is a reference."""
        member, offset = data_type.find(name)
        return followed(Member(plain(member.data_type), value, offset))

    def _named_bit(self, node: syntax.MemberAccess, value: Value) -> Value:
        """Check ``x.ALARM``: the bit whose number is a constant or a value of an enumeration."""
        constant = self.names.value(syntax.Name(node.at, node.name))
        if type(constant) is Constant and kind_of(constant.type) is TypeKind.INTEGER:
            return self._bit(node, value, int(constant.value))
        message = f"{value.type} has no members, and no constant is called {node.name}"
        self.error(node, FindingCode.NO_MEMBERS, message, _pointer_hint(value.type))
        return NOTHING

    def _part(self, node: syntax.MemberAccess, value: Value) -> Value:
        """Check ``.%X3``, ``.%B1``, ``.%W0`` and ``.%D0``: a part of an integer."""
        letter, digits = node.name[1:2].upper(), node.name[2:]
        if letter == "X" and digits.isdecimal():
            return self._bit(node, value, int(digits))
        part = _PARTS.get(letter)
        if part is None or not digits.isdecimal():
            message = f"{node.name} is no part of an integer; %X0, %B0, %W0 and %D0 are"
            self.error(node, FindingCode.WRONG_BIT, message)
            return NOTHING
        count = value.type.size // part.size if kind_of(value.type) is TypeKind.INTEGER else 0
        if not int(digits) < count:
            has = f"has no {node.name}"
            self.error(node, FindingCode.WRONG_BIT, f"{value.type} {has}")
            return NOTHING
        if not isinstance(value, PLACES) or isinstance(value, Bit):
            self.error(node, FindingCode.NO_VARIABLE, "only a variable has parts")
            return NOTHING
        keep_address(value)
        return Member(part, value, int(digits) * part.size)

    def _bit(self, node: syntax.MemberAccess, value: Value, number: int) -> Value:
        kind = kind_of(value.type)
        if kind is TypeKind.BOOL and number == 0:
            return value
        if kind is not TypeKind.INTEGER:
            message = f"{value.type} has no bits; only integers have"
            self.error(node, FindingCode.WRONG_BIT, message)
            return NOTHING
        bits = 8 * value.type.size
        if not 0 <= number < bits:
            self.error(node, FindingCode.WRONG_BIT, f"{value.type} has the bits 0 to {bits - 1}")
            return NOTHING
        return Bit(BOOL, value, number)

    def _index(self, node: syntax.Index) -> Value:
        value = self.value(node.base)
        array = value.type
        indices = [self._index_value(index) for index in node.indices]
        if not isinstance(array, ArrayType):
            found = self._indexed_address(value, indices)
            if found is not None:
                return found
            if array is not VOID:
                message = f"{array} cannot be indexed; it is no ARRAY"
                self.error(node, FindingCode.NO_ARRAY, message, _pointer_hint(array))
            return NOTHING
        if len(indices) != len(array.bounds):
            count = len(array.bounds)
            noun = "index" if count == 1 else "indices"
            message = f"{array} takes {count} {noun}, not {len(indices)}"
            self.error(node, FindingCode.WRONG_INDEX, message)
            return NOTHING
        for place, (each, (low, high)) in enumerate(zip(node.indices, array.bounds, strict=True)):
            index = indices[place]
            if type(index) is not Constant:
                indices[place] = self._checks.index(index, low, high)
            elif index.type is not VOID and not low <= int(index.value) <= high:
                message = f"index {index.value} is outside {low}..{high}"
                self.error(each, FindingCode.INDEX_OUTSIDE, message)
        return followed(Element(plain(array.element), value, array, indices))

    def _indexed_address(self, value: Value, indices: Sequence[Value]) -> Value | None:
        """Return ``p[i]`` of a pointer or a byte of a string, as CODESYS has them, else None."""
        if len(indices) != 1 or self.names.scope.dialect.case_sensitive:
            return None
        data_type = value.type
        lying: Type = CHAR
        address: Value = value
        if isinstance(data_type, ReferenceType) and data_type.target is not None:
            lying = plain(data_type.target)
        elif isinstance(data_type, StringType | WStringType) and isinstance(value, PLACES):
            lying = CHAR if isinstance(data_type, StringType) else WCHAR
            keep_address(value)
            address = Address(UDINT, value)
        else:
            return None
        size = Constant(ANY_INT, lying.size)
        return Target(lying, Binary(UDINT, "+", address, Binary(DINT, "*", indices[0], size)))

    def _index_value(self, node: Expression) -> Value:
        index = self.value(node)
        kind = kind_of(index.type)
        if kind is TypeKind.INTEGER or kind is TypeKind.VOID:
            return index if kind is TypeKind.INTEGER else Constant(VOID, 0)
        self.error(node, FindingCode.WRONG_INDEX, f"an index is an integer, not {index.type}")
        return NOTHING

    def _dereference(self, node: syntax.Dereference) -> Value:
        value = self.value(node.base)
        data_type = value.type
        if isinstance(data_type, ReferenceType):
            target = data_type.target
            return followed(Target(VOID if target is None else plain(target), value))
        if not isinstance(value, Target) and data_type is not VOID:
            self.error(node, FindingCode.NO_REFERENCE, f"{data_type} is no pointer")
        return value

    # Operations

    def _unary(self, node: syntax.Unary) -> Value:
        value = self.value(node.operand)
        if node.operator == "+":
            return value
        if isinstance(value, Constant) and not isinstance(value.value, str):
            folded = operations.folded(node.operator, value)
            if folded is not None:
                return folded
        if operations.takes(node.operator, value.type):
            return Unary(value.type, node.operator, value)
        if value.type is not VOID:
            message = f"{node.operator} does not take {value.type}"
            self.error(node, FindingCode.WRONG_OPERANDS, message)
        return NOTHING

    def _binary(self, node: syntax.Binary) -> Value:
        """Check a chain of operators from its left end, for it may be hundreds long."""
        chain = [node]
        while type(chain[-1].left) is syntax.Binary:
            chain.append(chain[-1].left)
        left = self.value(chain[-1].left)
        for each in reversed(chain):
            left = self._operation(each, left, self.value(each.right))
        return left

    def _operation(self, node: syntax.Binary, left: Value, right: Value) -> Value:
        left, right = self._operand_of(left), self._operand_of(right)
        if self._is_standard:
            left, right = operations.widened(left, right)
            date = operations.dated(node.operator, left, right)
            if date is not None:
                return date
        if node.operator == "/":
            right = self._checks.divisor(right)
        found = operations.operation(node.operator, left, right)
        if found is None:
            if left.type is not VOID and right.type is not VOID:
                message = f"{node.operator} does not take {left.type} and {right.type}"
                self.error(node, FindingCode.WRONG_OPERANDS, message)
            return NOTHING
        if node.operator in ("/", "MOD") and _is_zero(right):
            self._division_by_zero(node, found)
        elif operations.mixes_signs(found):
            message = f"{left.type} and {right.type} are compared as unsigned numbers"
            self.findings.warning(node, FindingCode.SIGN_MIXED, message)
        return found

    def _operand_of(self, value: Value) -> Value:
        """Return what operations take of a value: the address in a reference or an interface."""
        if value.type in self.names.symbols.interfaces:
            return Member(UDINT, value, 0)
        return address_of_aggregate(value)

    def _division_by_zero(self, node: syntax.Binary, value: Binary | Any) -> None:
        if node.operator == "/" and kind_of(value.type) is not TypeKind.REAL:
            self.error(node, FindingCode.DIVISION_BY_ZERO, "division by zero")

    def _call(self, node: syntax.Call) -> Value:
        raise NotImplementedError

    # Uses

    def condition(self, node: Expression) -> Value:
        """Check a condition."""
        value = self.value(node)
        kind = kind_of(value.type)
        if kind is not TypeKind.BOOL and kind is not TypeKind.VOID:
            is_number = isinstance(value, Constant) and value.value in (0, 1)
            if not is_number:
                message = f"a condition is a BOOL, not {value.type}"
                self.error(node, FindingCode.NO_CONDITION, message)
        return value

    def check_fit(self, node: Expression, value: Value, target: Type) -> None:
        """Tell where ``value`` does not go into a variable of type ``target`` by itself."""
        if value.type is target:
            return
        found = fit(value, target)
        if found is Fit.EXACT:
            return
        is_number = isinstance(value, Constant) and value.type is ANY_INT
        shown = f"{value.value}" if is_number and isinstance(value, Constant) else f"{value.type}"
        if found is Fit.NARROWED:
            if is_number:
                stored = number_type(target).wrap(int(shown))
                message = f"{shown} does not fit {target}; {stored} is stored"
            else:
                message = f"{shown} may not fit {target}"
            self.findings.warning(node, FindingCode.NARROWED, message)
        elif is_number and kind_of(target) is TypeKind.INTEGER:
            self.error(node, FindingCode.VALUE_OUTSIDE, f"{shown} does not fit {target}")
        else:
            hint = _conversion_hint(value.type, target)
            self.error(node, FindingCode.CANNOT_CONVERT, f"{shown} does not go into {target}", hint)

    def integer(self, node: Expression, value: Value) -> bool:
        """Return True for an integer, else tell that it is none."""
        if kind_of(value.type) in (TypeKind.INTEGER, TypeKind.VOID):
            return True
        self.error(node, FindingCode.CANNOT_CONVERT, f"an integer was expected, not {value.type}")
        return False


def address_of_aggregate(value: Value) -> Value:
    """Return the address in a reference to a STRUCT or an ARRAY: what calculations take of it."""
    if type(value) is not Target or kind_of(value.type) not in (TypeKind.STRUCT, TypeKind.ARRAY):
        return value
    return value.pointer if isinstance(value.pointer.type, ReferenceType) else value


def _is_zero(value: Value) -> bool:
    return isinstance(value, Constant) and value.value == 0


def _pointer_hint(data_type: Type) -> str:
    is_pointer = isinstance(data_type, ReferenceType)
    return "^ follows a pointer" if is_pointer else ""


def _conversion_hint(source: Type, target: Type) -> str:
    names = [t.name.partition("[")[0] for t in (source, target)]
    known = {*ALL_ELEMENTARY, "STRING", "WSTRING"}
    return f"use {'_TO_'.join(names)}" if known.issuperset(names) else ""


_RULES: dict[type, Callable[[ExpressionChecker, Any], Value]] = {
    syntax.Name: ExpressionChecker._name,
    syntax.Literal: ExpressionChecker._literal,
    syntax.DirectAddress: ExpressionChecker._address,
    syntax.MemberAccess: ExpressionChecker._member,
    syntax.Index: ExpressionChecker._index,
    syntax.Dereference: ExpressionChecker._dereference,
    syntax.Unary: ExpressionChecker._unary,
    syntax.Binary: ExpressionChecker._binary,
    syntax.Call: lambda checker, node: checker._call(node),
}
