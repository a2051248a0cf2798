"""The C header of a scope, in the shape Automation Studio generates it.

Types in the order in which C needs them, then constants, variables, prototypes. STRUCTs keep their
order, data blocks have that of their layout, with the section of each group in a comment. The
header needs ``bur/plctypes.h``: Automation Studio's own, or on a host the one in
``st_types/writers/include``.

Names that C does not allow get an underscore at their end, and so do names that are taken already.
A member whose name only C++ does not allow has the underscore in C++ only. An ARRAY whose lower
bound is not 0 starts at index 0 in C, as a comment beside it says; Automation Studio leaves out
types with such arrays.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from st_types.types.derived import (
    AliasType,
    ArrayType,
    DataBlockType,
    EnumerationType,
    Member,
    ReferenceType,
    Section,
    StringType,
    StructType,
    SubrangeType,
    UnionType,
    WStringType,
    is_digital,
    resolve_alias,
)
from st_types.types.elementary import DINT, LONG_TIMES, DataType, ElementaryType
from st_types.types.paths import inner_types
from st_types.writers.plan import is_generic, lacks_types, parameters_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from st_types.resolve.declared import DeclaredVariable
    from st_types.resolve.scope import Scope

C_TYPES = {
    "BOOL": "plcbit",
    "SINT": "signed char",
    "INT": "signed short",
    "DINT": "signed long",
    "LINT": "signed long long",
    "USINT": "unsigned char",
    "UINT": "unsigned short",
    "UDINT": "unsigned long",
    "ULINT": "unsigned long long",
    "BYTE": "plcbyte",
    "WORD": "plcword",
    "DWORD": "plcdword",
    "LWORD": "plclword",
    "REAL": "float",
    "LREAL": "double",
    "TIME": "plctime",
    "DATE": "plcdate",
    "TIME_OF_DAY": "plctod",
    "DATE_AND_TIME": "plcdt",
    "CHAR": "unsigned char",
    "WCHAR": "unsigned short",
    **dict.fromkeys((t.name for t in LONG_TIMES.values()), "signed long long"),
}
"""C type of each elementary type."""

C_KEYWORDS = frozenset(
    [
        *("auto", "break", "case", "char", "const", "continue", "default", "do", "double"),
        *("else", "enum", "extern", "float", "for", "goto", "if", "inline", "int", "long"),
        *("register", "restrict", "return", "short", "signed", "sizeof", "static", "struct"),
        *("switch", "typedef", "union", "unsigned", "void", "volatile", "while", "asm"),
        *("typeof", "bool", "true", "false", "linux", "unix", "i386"),
    ]
)
"""Words of C, and macros of gcc, that cannot be names."""

CPP_KEYWORDS = frozenset(
    [
        *("and", "and_eq", "bitand", "bitor", "compl", "not", "not_eq", "or", "or_eq", "xor"),
        *("xor_eq", "alignas", "alignof", "catch", "char8_t", "char16_t", "char32_t", "class"),
        *("concept", "consteval", "constexpr", "constinit", "const_cast", "co_await"),
        *("co_return", "co_yield", "decltype", "delete", "dynamic_cast", "explicit", "export"),
        *("friend", "mutable", "namespace", "new", "noexcept", "nullptr", "operator", "private"),
        *("protected", "public", "reinterpret_cast", "requires", "static_assert"),
        *("static_cast", "template", "this", "thread_local", "throw", "try", "typeid"),
        *("typename", "using", "virtual", "wchar_t"),
    ]
)
"""Words that only C++ does not allow as names."""

MAX_REFERENCES = 8
"""References to references that are followed; C has no type for those that end nowhere."""

_RESERVED = C_KEYWORDS | CPP_KEYWORDS

GLOBAL = "_GLOBAL"
LOCAL = "_BUR_LOCAL"
"""What stands before the variables of a project and of a program."""

_SECTIONS = {
    Section.INPUT: "VAR_INPUT",
    Section.OUTPUT: "VAR_OUTPUT",
    Section.IN_OUT: "VAR_IN_OUT",
    Section.INTERNAL: "VAR",
}


def c_header(header: Header, name: str, includes: Sequence[str] = ()) -> str:
    """Return the text of a header file.

    Args:
        header: what it declares; what has no layout is left out.
        name: of the library or the program, for the guard.
        includes: the files of the headers that ``header`` rests on.
    """
    guard = f"_{''.join(c if c.isalnum() else '_' for c in name).upper()}_H_"
    head = f"/* {name}: written by plcsim types header */\n\n#ifndef {guard}\n#define {guard}\n"
    head += "\n#include <bur/plctypes.h>\n" + "".join(f'#include "{file}"\n' for file in includes)
    head += '\n#ifdef __cplusplus\nextern "C" {\n#endif\n'
    tail = f"\n#ifdef __cplusplus\n}}\n#endif\n\n#endif /* {guard} */\n"
    return head + "".join(line + "\n" for line in header.lines()) + tail


class Header:
    """Writes the C declarations of a scope.

    Args:
        scope: the declarations.
        included: the headers that it includes, and those that they include.
        variables: what stands before a variable: ``_GLOBAL``, in a program ``_BUR_LOCAL`` or
            ``_LOCAL``, or ``extern``; with "" only constants are written.
        c_types: C type of each elementary type.

    Attributes:
        scope: the declarations.
        names: typedef name of each type that is written or included.
    """

    def __init__(
        self,
        scope: Scope,
        included: Sequence[Header] = (),
        *,
        variables: str = GLOBAL,
        c_types: Mapping[str, str] = C_TYPES,
    ) -> None:
        self.scope = scope
        self._storage = variables
        self._c_types = c_types
        self._taken: set[str] = set(_RESERVED)
        self.names: dict[DataType[object], str] = {}
        self._tags: dict[DataType[object], str] = {}
        self._written: set[DataType[object]] = set()
        self._complete: set[DataType[object]] = set()
        self._references = 0
        for other in included:
            self._taken |= other._taken
            self.names |= other.names
            self._tags |= other._tags
            self._written |= other._written
            self._complete |= other._complete

    def lines(self) -> Iterator[str]:
        """Yield the lines between the head and the tail of the header."""
        types = list(self.scope.data_types())
        for data_type in types:
            self._name(data_type)
        for data_type in types:
            yield from self._type(data_type)
        for used in self._used_types():
            if used is not None:
                yield from self._needed(used)
        yield from self._constants()
        yield from self._variables()
        yield from self._prototypes(types)

    def _used_types(self) -> Iterator[DataType[object] | None]:
        yield from (variable.data_type for variable in self.scope.variables)
        for function in self.scope.functions:
            yield function.result
            yield from (variable.data_type for variable in parameters_of(function))

    def _name(self, data_type: DataType[object]) -> str:
        if data_type not in self.names:
            is_block = isinstance(data_type, DataBlockType)
            tag = self._free(data_type.name)
            self._tags[data_type] = tag
            self.names[data_type] = self._free(tag + "_typ") if is_block else tag
        return self.names[data_type]

    def _free(self, name: str) -> str:
        while name in self._taken:
            name += "_"
        self._taken.add(name)
        return name

    def _constants(self) -> Iterator[str]:
        found = [v for v in self.scope.variables if v.is_constant and v.data_type is not None]
        named = [(self._free(v.name), v) for v in found]
        simple = [(name, v) for name, v in named if _value(v)]
        others = [(name, v) for name, v in named if not _value(v)]
        if named:
            yield from ("", "/* Constants */")
        if simple:
            yield "#ifdef _REPLACE_CONST"
            yield from (f"#define {name} {_value(variable)}" for name, variable in simple)
            yield "#else"
            yield from (self._constant(name, variable) for name, variable in simple)
            yield "#endif"
        yield from (self._constant(name, variable) for name, variable in others)

    def _constant(self, name: str, variable: DeclaredVariable) -> str:
        assert variable.data_type is not None
        mark = "_LOCAL_CONST" if self._storage == LOCAL else "_GLOBAL_CONST"
        return f"{mark} {self._declarator(variable.data_type, name)};"

    def _variables(self) -> Iterator[str]:
        found = [v for v in self.scope.variables if not v.is_constant and v.data_type is not None]
        if not found or not self._storage:
            return
        yield from ("", "/* Variables */")
        taken: set[str] = set()  # not those of other headers: a local variable hides a global one
        for variable in found:
            assert variable.data_type is not None
            name = variable.name
            while name in self._taken or name in taken:
                name += "_"
            taken.add(name)
            is_retained = self._storage[:1] == "_" and "RETAIN" in variable.block.qualifiers
            retain = "_RETAIN" if is_retained else ""
            yield f"{self._storage}{retain} {self._declarator(variable.data_type, name)};"

    def _type(self, data_type: DataType[object]) -> Iterator[str]:
        """Yield the declaration of a named type, after those of the types that lie in it."""
        if data_type in self._written:
            return
        self._written.add(data_type)
        match data_type:
            case StructType():
                for inner in inner_types(data_type):
                    yield from self._needed(inner)
                yield from self._struct(data_type)
                self._complete.add(data_type)
            case EnumerationType():
                yield from self._enumeration(data_type)
            case AliasType(target=target):
                yield from self._needed(target)
                yield from ("", f"typedef {self._declarator(target, self._name(data_type))};")
            case SubrangeType(base=base):
                yield from ("", f"typedef {self._declarator(base, self._name(data_type))};")

    def _needed(self, data_type: DataType[object]) -> Iterator[str]:
        """Yield what C has to know of a type before a member of it."""
        match data_type:
            case ArrayType(element=element):
                yield from self._needed(element)
            case ReferenceType(target=DataType() as target):
                inner = resolve_alias(target)
                if not isinstance(inner, StructType) and self._references < MAX_REFERENCES:
                    self._references += 1
                    yield from self._needed(inner)
                    self._references -= 1
            case StructType() | EnumerationType() | AliasType():
                yield from self._type(data_type)
            case SubrangeType() if data_type in self.names:
                yield from self._type(data_type)

    def _enumeration(self, data_type: EnumerationType[object]) -> Iterator[str]:
        """Yield an enum; where it is no DINT, C has the names apart from the type."""
        name = self._name(data_type)
        is_enum = data_type.base is DINT
        yield from ("", f"typedef enum {self._tags[data_type]} {{" if is_enum else "enum {")
        for value_name, value in data_type.values.items():
            yield f"\t{self._free(value_name)} = {_integer(value)},"
        yield f"}} {name};" if is_enum else "};"
        if not is_enum:
            yield f"typedef {self._declarator(data_type.base, name)};"

    def _struct(self, data_type: StructType[object]) -> Iterator[str]:
        name = self._name(data_type)
        keyword = _keyword(data_type)
        yield from ("", f"typedef {keyword} {self._tags[data_type]} {{")
        taken = set(C_KEYWORDS)
        group = ""
        for _, member in sorted(
            zip(data_type.offsets, data_type.members, strict=True), key=_offset
        ):
            if isinstance(data_type, DataBlockType) and group != _group(member):
                group = _group(member)
                yield f"\t/* {group} */"
            member_name = member.name
            while member_name in taken:
                member_name += "_"
            taken.add(member_name)
            yield from self._member(member, member_name)
        yield f"}} {name};"

    def _member(self, member: Member, name: str) -> Iterator[str]:
        line = f"\t{self._declarator(member.data_type, name)};{_lower_bounds(member)}"
        if name not in CPP_KEYWORDS:
            yield line
            return
        yield from ("#ifdef __cplusplus", f"\t{self._declarator(member.data_type, name + '_')};")
        yield from ("#else", line, "#endif")

    def _declarator(self, data_type: DataType[object], name: str) -> str:
        """Return the C declaration of ``name`` without its semicolon, of the type without one."""
        return self._declared(data_type, name).rstrip()

    def _declared(self, data_type: DataType[object], name: str) -> str:
        match data_type:
            case ElementaryType():
                return f"{self._c_types[data_type.name]} {name}"
            case StringType(length=length):
                return f"plcstring {name}[{length + 1}]"
            case WStringType(length=length):
                return f"plcwstring {name}[{length + 1}]"
            case ArrayType(element=element, bounds=bounds):
                lengths = "".join(f"[{high - low + 1}]" for low, high in bounds)
                return self._declarator(element, name + lengths)
            case SubrangeType(base=base) if data_type not in self.names:
                return self._declarator(base, name)
            case ReferenceType(target=target):
                return self._pointer(target, name)
            case AliasType() | SubrangeType():
                return f"{self._name(data_type)} {name}"
        keyword = _keyword(data_type)
        self._name(data_type)
        return f"{keyword} {self._tags[data_type]} {name}"

    def _pointer(self, target: DataType[object] | None, name: str) -> str:
        self._references += 1
        known = target if self._references <= MAX_REFERENCES else None
        declared = self._pointer_to(known, name)
        self._references -= 1
        return declared

    def _pointer_to(self, target: DataType[object] | None, name: str) -> str:
        match resolve_alias(target) if target is not None else None:
            case None:
                return f"void* {name}"
            case StringType():
                return f"plcstring* {name}"
            case WStringType():
                return f"plcwstring* {name}"
            case ArrayType() as array:
                inner = _innermost(array)
                if isinstance(inner, StructType) and inner not in self._complete:
                    return f"{self._declarator(inner, '')}* {name}"  # C wants complete elements
                return self._declarator(array, f"(*{name})")
            case other:
                return f"{self._declarator(other, '')}* {name}"

    def _prototypes(self, types: Sequence[DataType[object]]) -> Iterator[str]:
        blocks = [data_type for data_type in types if isinstance(data_type, DataBlockType)]
        functions = self.scope.functions
        if blocks or functions:
            yield from ("", "/* Prototypes */")
        for block in blocks:
            yield f"_BUR_PUBLIC void {self._tags[block]}(struct {self._tags[block]}* inst);"
        for function in functions:
            if lacks_types(function):
                continue
            if is_generic(function.node.result):
                yield f"/* {function.name} gives any type: C has no prototype for it */"
                continue
            parameters = ", ".join(self._parameter(v) for v in parameters_of(function)) or "void"
            name = self._free(function.name)
            yield f"_BUR_PUBLIC {self._result(function.result, f'{name}({parameters})')};"

    def _parameter(self, variable: DeclaredVariable) -> str:
        """Return a parameter as Automation Studio's headers have it.

        What is no scalar goes by its address, and so does the REFERENCE TO a STRUCT or a STRING,
        but not to another name of one.
        """
        name = variable.name + "_" if variable.name in _RESERVED else variable.name
        declared = variable.data_type
        if declared is None:
            return f"unsigned long {name}"
        data_type = resolve_alias(declared)
        is_input = variable.block.section == "VAR_INPUT"
        match data_type:
            case ArrayType() | StringType() | WStringType() if isinstance(declared, AliasType):
                return self._declarator(declared, name)
            case ArrayType():
                return self._declarator(_of_addresses(data_type), name)
            case ReferenceType(target=DataType() as target) if is_input:
                inner = resolve_alias(target)
                if isinstance(inner, ArrayType):
                    return self._pointer(_of_addresses(inner), name)
                if isinstance(target, AliasType):
                    return self._declarator(target, f"*{name}")
                is_address = isinstance(inner, StructType | StringType | WStringType)
                return self._pointer(data_type if is_address else inner, name)
        is_scalar = isinstance(data_type, _SCALARS)
        return (
            self._declarator(declared, name)
            if is_scalar and is_input
            else self._pointer(declared, name)
        )

    def _result(self, declared: DataType[object] | None, call: str) -> str:
        if declared is None:
            return f"void {call}"
        data_type = resolve_alias(declared)
        if isinstance(data_type, StringType | WStringType):
            return self._pointer(data_type, call)
        is_scalar = isinstance(data_type, _SCALARS)
        return self._declarator(declared, call) if is_scalar else f"void* {call}"


def _of_addresses(array: ArrayType[object]) -> ArrayType[object]:
    """Return an ARRAY as a parameter: of STRINGs it holds addresses."""
    element = resolve_alias(array.element)
    if isinstance(element, StringType | WStringType):
        return ArrayType(ReferenceType(element), array.bounds)
    return array


_SCALARS = (ElementaryType, EnumerationType, SubrangeType, ReferenceType)


def _innermost(data_type: DataType[object]) -> DataType[object]:
    while isinstance(data_type, ArrayType):
        data_type = resolve_alias(data_type.element)
    return data_type


def _offset(pair: tuple[int, Member]) -> int:
    return pair[0]


def _group(member: Member) -> str:
    kind = "digital" if is_digital(member.data_type) else "analog"
    if member.section is Section.IN_OUT:
        kind = "analog and digital"  # references to either kind
    return f"{_SECTIONS[member.section]} ({kind})"


def _lower_bounds(member: Member) -> str:
    if not isinstance(member.data_type, ArrayType):
        return ""
    lows = [low for low, _ in member.data_type.bounds]
    return (
        f" /* index 0 here is {', '.join(map(str, lows))} in {member.name} */" if any(lows) else ""
    )


def _value(variable: DeclaredVariable) -> str:
    """Return the value of a constant in C, empty where it has no simple one."""
    match variable.initial:
        case bool(value):
            return str(int(value))
        case int(value):
            return _integer(value)
        case float(value) if math.isfinite(value):
            return repr(value)
        case str(value):
            return _text(value)
    return ""


def _keyword(data_type: DataType[object]) -> str:
    if isinstance(data_type, UnionType):
        return "union"
    return "enum" if isinstance(data_type, EnumerationType) else "struct"


def _integer(value: int) -> str:
    if value in (-(2**31), -(2**63)):
        return f"({_integer(value + 1)} - 1)"
    suffix = "" if value < 2**31 else "U" if value < 2**32 else "LL" if value < 2**63 else "ULL"
    return f"{value}{suffix}" if value > -(2**31) else f"{value}LL"


def _text(value: str) -> str:
    data = value.encode("latin-1", "replace")
    return '"' + "".join(_character(byte) for byte in data) + '"'


def _character(byte: int) -> str:
    plain = 32 <= byte < 127 and chr(byte) not in '"\\?'
    return chr(byte) if plain else f"\\{byte:03o}"
