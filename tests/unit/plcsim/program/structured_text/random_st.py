"""Random programs in Structured Text, each with its translation to C.

The translation says what Automation Studio's compiler makes of a program (docs/compliance.md): it
is written down here a second time, as text, and shares nothing with our compiler. A program has
variables of all elementary types, arrays, structures, strings, references and function blocks.
"""

import random

BASE = 0x20000
"""Address of the variables, in C too: what lies at an address is reached through it."""

TYPES = {
    "BOOL": ("uint8_t", 1, "u"),
    "SINT": ("int8_t", 1, "s"),
    "USINT": ("uint8_t", 1, "u"),
    "INT": ("int16_t", 2, "s"),
    "UINT": ("uint16_t", 2, "u"),
    "DINT": ("int32_t", 4, "s"),
    "UDINT": ("uint32_t", 4, "u"),
    "REAL": ("float", 4, "f"),
    "LREAL": ("double", 8, "f"),
}
INTEGERS = ["SINT", "USINT", "INT", "UINT", "DINT", "UDINT"]
REALS = ["REAL", "LREAL"]
SIZES = {name: size for name, (_, size, _) in TYPES.items()}
HEAD = """
#include <stdint.h>
#include <string.h>
extern uint8_t *M;
#define AT(T, address) (*(T *)(M + ((uint32_t)(address) - 0x20000u)))
static void string_assign(char *target, const char *source, int limit) {
    int i;
    for (i = 0; i < limit && source[i] != 0; i++) target[i] = source[i];
    target[i] = 0;
}
static int string_order(const char *a, const char *b) {
    while (*a && *a == *b) a++, b++;
    return (int)(unsigned char)*a - (int)(unsigned char)*b;
}
"""


def common(a, b):
    """The type of an operation on two numbers: as the checker has it, written once more."""
    if a == b:
        return a
    for real in ("LREAL", "REAL"):
        if real in (a, b):
            return real
    signs = TYPES[a][2] + TYPES[b][2]
    if signs in ("ss", "uu"):
        return a if SIZES[a] >= SIZES[b] else b
    signed, unsigned = (a, b) if TYPES[a][2] == "s" else (b, a)
    if SIZES[signed] > SIZES[unsigned]:
        return signed
    return {1: "INT", 2: "DINT", 4: "UDINT"}[SIZES[unsigned]]


class Term:
    """A value: its type (None for a whole number that takes any), its two texts."""

    def __init__(self, type_name, st, c, *, leaf=False):
        self.type = type_name
        self.st = st
        self.c = c
        self.leaf = leaf


class Program:
    """A random program.

    Attributes:
        st: its text.
        c: its translation, a function ``cyclic_NAME(void)``.
    """

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.name = f"p{seed}"
        self.variables = []  # name, ST type, C type, size, alignment, count
        self.places = {}  # type: [(st, c)]
        self.strings = []
        self.references = []
        self.blocks = []
        self.loops = 0
        self.edges = 0
        self._declare()
        body = [self.statement(0) for _ in range(self.random.randint(3, 12))]
        self.st = self._st(body)
        self.c = self._c(body)

    # Variables

    def _declare(self):
        offset = 0

        def add(name, st_type, c_type, size, alignment):
            nonlocal offset
            offset += -offset % alignment
            self.variables.append((name, st_type, c_type, offset, size))
            offset += size
            return self.variables[-1]

        for type_name, (c_type, size, _) in TYPES.items():
            for number in range(2):
                name = f"{type_name.lower()}{number}"
                place = add(name, type_name, c_type, size, min(size, 4))
                self._known(type_name, name, f"AT({c_type}, {BASE + place[3]})")
        for type_name in ("INT", "USINT", "DINT", "REAL"):
            c_type, size, _ = TYPES[type_name]
            low, count = self.random.choice([(-2, 5), (0, 4), (1, 3)])
            name = f"list_{type_name.lower()}"
            place = add(
                name,
                f"ARRAY[{low}..{low + count - 1}] OF {type_name}",
                c_type,
                count * size,
                min(size, 4),
            )
            self._known(type_name, (name, low, count), (c_type, BASE + place[3], size))
        for number, length in enumerate((5, 12)):
            place = add(f"text{number}", f"STRING[{length}]", "char", length + 1, 1)
            self.strings.append((f"text{number}", f"(char *)&AT(char, {BASE + place[3]})", length))
        for number in range(2):  # edges are hidden in ours, and lie in C's memory behind the rest
            place = add(f"pulse{number}", "Pulse", None, 8, 2)
            self.blocks.append((f"pulse{number}", BASE + place[3]))
        for type_name in ("INT", "UDINT"):
            c_type, size, _ = TYPES[type_name]
            name = f"ref_{type_name.lower()}"
            place = add(name, f"REFERENCE TO {type_name}", None, 4, 4)
            self.references.append((name, type_name, BASE + place[3]))
            self._known(type_name, name, f"AT({c_type}, AT(uint32_t, {BASE + place[3]}))")
        self.size = offset

    def _known(self, type_name, st, c):
        self.places.setdefault(type_name, []).append((st, c))

    def place(self, type_name, depth=0):
        """A variable or an element."""
        st, c = self.random.choice(self.places[type_name])
        if isinstance(st, str):
            return Term(type_name, st, c, leaf=True)
        name, low, count = st
        c_type, address, size = c
        if self.random.random() < 0.6:
            index = self.random.randrange(count)
            return Term(
                type_name,
                f"{name}[{low + index}]",
                f"AT({c_type}, {address + index * size})",
                leaf=True,
            )
        inner = self.value(self.random.choice(["INT", "USINT", "DINT"]), depth + 2)
        text = f"((int32_t){inner.c} % {count} + {count}) % {count}"
        st_index = f"(({inner.st}) MOD {count} + {count}) MOD {count} + {low}"
        if inner.type in ("USINT", "UINT", "UDINT") or inner.type is None:
            inner = (
                self.place("INT", 9) if depth > 6 else Term("INT", "int0", self.places["INT"][0][1])
            )
            text = f"((int32_t){inner.c} % {count} + {count}) % {count}"
            st_index = f"(({inner.st}) MOD {count} + {count}) MOD {count} + {low}"
        return Term(
            type_name, f"{name}[{st_index}]", f"AT({c_type}, {address} + ({text}) * {size})"
        )

    # Values

    def value(self, type_name, depth=0):
        """A value of a type, or of one that goes into it by itself."""
        if type_name == "BOOL":
            return self.truth(depth)
        return self.real(depth, type_name) if type_name in REALS else self.integer(depth)

    def typed(self, type_name, depth=0):
        """A value that is no bare number, for that might not fit."""
        found = self.value(type_name, depth)
        return self.place("INT", depth) if found.type is None else found

    def literal(self):
        number = self.random.choice(
            [0, 1, 2, 3, 5, 7, 10, 100, 200, 1000, 40000, 70000, 2000000000]
        )
        return Term(None, str(number), str(number), leaf=True)

    def integer(self, depth):
        pick = self.random.random()
        if depth > 3 or pick < 0.3:
            return self.place(self.random.choice(INTEGERS), depth)
        if pick < 0.42:
            return self.literal()
        if pick < 0.75:
            return self.arithmetic(depth)
        return self.random.choice(
            [self.cast, self.rounded, self.absolute, self.negative, self.selected]
        )(depth)

    def numbers(self, depth, make):
        a, b = make(depth + 1), make(depth + 1)
        if a.type is None and b.type is None:
            a = self.place(self.random.choice(INTEGERS), depth + 1)
        return a, b, common(a.type or b.type, b.type or a.type)

    def arithmetic(self, depth):
        operator = self.random.choice(["+", "-", "*", "/", "MOD", "AND", "OR", "XOR"])
        a, b, type_name = self.numbers(depth, self.integer)
        if operator in ("/", "MOD"):
            b = Term(None, *(self.random.choice(["1", "2", "3", "7", "100"]),) * 2)
            if a.type is None:
                a = self.place("INT", depth)
            type_name = a.type
            cast = "uint32_t" if TYPES[type_name][2] == "u" else "int32_t"
            sign = {"/": "/", "MOD": "%"}[operator]
            return Term(
                type_name,
                f"({a.st} {operator} {b.st})",
                f"((({cast})({a.c})){sign}(({cast})({b.c})))",
            )
        sign = {"AND": "&", "OR": "|", "XOR": "^"}.get(operator, operator)
        return Term(type_name, f"({a.st} {operator} {b.st})", f"({a.c}{sign}{b.c})")

    def cast(self, depth):
        target = self.random.choice(INTEGERS)
        source = self.place(self.random.choice(INTEGERS), depth + 1)
        return Term(
            target, f"{source.type}_TO_{target}({source.st})", f"(({TYPES[target][0]})({source.c}))"
        )

    def rounded(self, depth):
        target = self.random.choice(["SINT", "INT", "DINT", "USINT", "UINT", "UDINT"])
        source = self.place(self.random.choice(REALS), depth + 1)
        x = f"({source.c})"
        text = f"(({TYPES[target][0]})({x}>=0.0?{x}+0.5:{x}-0.5))"
        return Term(target, f"{source.type}_TO_{target}({source.st})", text)

    def absolute(self, depth):
        a = self.place(self.random.choice(["SINT", "INT", "DINT"]), depth + 1)
        return Term(a.type, f"ABS({a.st})", f"(({a.c})<0?-({a.c}):({a.c}))")

    def negative(self, depth):
        a = self.place(self.random.choice(["SINT", "INT", "DINT"]), depth + 1)
        return Term(a.type, f"(-{a.st})", f"(-{a.c})")

    def selected(self, depth):
        type_name = self.random.choice(INTEGERS)
        g, a, b = self.truth(depth + 2), self.place(type_name, 9), self.place(type_name, 9)
        return Term(type_name, f"SEL({g.st}, {a.st}, {b.st})", f"(({g.c})?({b.c}):({a.c}))")

    def real(self, depth, wanted="LREAL"):
        pick = self.random.random()
        types = ["REAL"] if wanted == "REAL" else REALS
        if depth > 3 or pick < 0.45:
            return self.place(self.random.choice(types), depth)
        if pick < 0.6:
            number = self.random.choice(["0.1", "1.5", "2.0", "1000.25"])
            a = self.place("REAL", depth + 1)
            operator = self.random.choice("+-*/")
            return Term("REAL", f"({a.st} {operator} {number})", f"({a.c}{operator}{number})")
        a = self.place(self.random.choice(types), depth + 1)
        b = self.random.choice([self.integer, lambda d: self.real(d, wanted)])(depth + 2)
        operator = self.random.choice("+-*")
        type_name = common(a.type, b.type or a.type)
        return Term(type_name, f"({a.st} {operator} {b.st})", f"({a.c}{operator}{b.c})")

    # Truth values

    def truth(self, depth):
        pick = self.random.random()
        if depth > 3 or pick < 0.25:
            return self.place("BOOL", depth)
        if pick < 0.6:
            return self.comparison(depth)
        if pick < 0.7:
            a = self.truth(depth + 1)
            return Term("BOOL", f"(NOT {a.st})", f"({a.c}^1)")
        if pick < 0.78:
            return self.bit(depth)
        if pick < 0.84:
            return self.strings_compared()
        a, b = self.truth(depth + 1), self.truth(depth + 1)
        operator = self.random.choice(["AND", "OR", "XOR"])
        sign = {"AND": "&", "OR": "|", "XOR": "^"}[operator]
        return Term("BOOL", f"({a.st} {operator} {b.st})", f"({a.c}{sign}{b.c})")

    def comparison(self, depth):
        operator = self.random.choice(["=", "<>", "<", ">", "<=", ">="])
        sign = {"=": "==", "<>": "!="}.get(operator, operator)
        if self.random.random() < 0.2:
            a, b = self.real(depth + 1), self.real(depth + 1)
            return Term("BOOL", f"({a.st} {operator} {b.st})", f"({a.c}{sign}{b.c})")
        a, b, type_name = self.numbers(depth, self.integer)
        cast = "uint32_t" if TYPES[type_name][2] == "u" else "int32_t"
        return Term(
            "BOOL", f"({a.st} {operator} {b.st})", f"((({cast})({a.c})){sign}(({cast})({b.c})))"
        )

    def bit(self, depth):
        a = self.place(self.random.choice(INTEGERS), depth + 1)
        number = self.random.randrange(8 * SIZES[a.type])
        return Term("BOOL", f"{a.st}.{number}", f"(({a.c}>>{number})&1)")

    def strings_compared(self):
        (a, c, _), (b, d, _) = self.random.choice(self.strings), self.random.choice(self.strings)
        operator = self.random.choice(["=", "<", ">="])
        sign = {"=": "=="}.get(operator, operator)
        return Term("BOOL", f"({a} {operator} {b})", f"(string_order({c},{d}){sign}0)")

    # Statements, each as its two texts

    def statement(self, depth):
        makers = [self.assignment] * 8
        makers += [self.bit_assignment, self.string_assignment, self.link, self.pulse]
        if depth < 3:
            makers += [self.if_, self.if_, self.case, self.for_, self.repeat]
        return self.random.choice(makers)(depth)

    def assignment(self, depth):
        type_name = self.random.choice([*TYPES])
        target, value = self.place(type_name, 2), self.typed(type_name)
        return f"{target.st} := {value.st};", f"{target.c}={value.c};"

    def bit_assignment(self, depth):
        target = self.place(self.random.choice(INTEGERS), 9)
        number, value = self.random.randrange(8 * SIZES[target.type]), self.truth(1)
        mask = 1 << number
        text = f"{{int v={value.c}; {target.c}=({target.c}&~{mask}u)|((v&1)?{mask}u:0u);}}"
        return f"{target.st}.{number} := {value.st};", text

    def string_assignment(self, depth):
        name, target, length = self.random.choice(self.strings)
        if self.random.random() < 0.6:
            text = self.random.choice(["", "a", "hello", "Hello World!", "0123456789abcdef"])
            return (
                f"{name} := '{text}';",
                f'string_assign({target},"{text}",{min(length, len(text))});',
            )
        other, source, size = self.random.choice(self.strings)
        return f"{name} := {other};", f"string_assign({target},{source},{min(length, size)});"

    def link(self, depth):
        name, type_name, address = self.random.choice(self.references)
        plain = [
            (st, c)
            for st, c in self.places[type_name]
            if isinstance(st, str) and not st.startswith("ref")
        ]
        st, c = self.random.choice(plain)
        offset = c.split(", ")[1].rstrip(")")
        return f"{name} ACCESS ADR({st});", f"AT(uint32_t, {address})={offset};"

    def pulse(self, depth):
        name, address = self.random.choice(self.blocks)
        value, step = self.truth(1), self.typed("INT", 1)
        c = f"AT(uint8_t,{address + 6})={value.c};AT(int16_t,{address})={step.c};pulse({address});"
        return f"{name}(x := {value.st}, step := {step.st});", c

    def body(self, depth):
        return [self.statement(depth + 1) for _ in range(self.random.randint(1, 3))]

    def if_(self, depth):
        condition, then, other = self.truth(1), self.body(depth), self.body(depth)
        st = f"IF {condition.st} THEN {join(then, 0)} ELSE {join(other, 0)} END_IF"
        return st, f"if({condition.c}){{{join(then, 1)}}}else{{{join(other, 1)}}}"

    def case(self, depth):
        selector = self.place(self.random.choice(INTEGERS), 9)
        labels = self.random.sample(range(-3, 8), 3)
        first, second, other = self.body(depth), self.body(depth), self.body(depth)
        st = (
            f"CASE {selector.st} OF {labels[0]}, {labels[1]}: {join(first, 0)} "
            f"10..99: {join(second, 0)} ELSE {join(other, 0)} END_CASE"
        )
        c = (
            f"switch({selector.c}){{case {labels[0]}:case {labels[1]}:{{{join(first, 1)}}}break;"
            f"case 10 ... 99:{{{join(second, 1)}}}break;default:{{{join(other, 1)}}}}}"
        )
        return st, c

    def for_(self, depth):
        self.loops += 1
        variable = f"loop{self.loops}"
        address = BASE + 4096 + 4 * self.loops
        first, last = self.random.randint(-3, 3), self.random.randint(-3, 6)
        step = self.random.choice([1, 1, 2, -1])
        sign = "<=" if step > 0 else ">="
        body = self.body(depth)
        left, after = self.random.choice(
            [("", ""), ("IF bool0 THEN EXIT; END_IF", "if(BOOL0)break;")]
        )
        after = after.replace("BOOL0", self.places["BOOL"][0][1])
        c = f"AT(int16_t,{address})"
        st = f"FOR {variable} := {first} TO {last} BY {step} DO {join(body, 0)} {left} END_FOR"
        return st, f"for({c}={first};{c}{sign}{last};{c}+={step}){{{join(body, 1)}{after}}}"

    def repeat(self, depth):
        self.loops += 1
        name, c = f"loop{self.loops}", f"AT(int16_t,{BASE + 4096 + 4 * self.loops})"
        body, condition = self.body(depth), self.truth(2)
        st = (
            f"{name} := 0; REPEAT {name} := {name} + 1; {join(body, 0)} "
            f"UNTIL {condition.st} OR {name} > 3 END_REPEAT"
        )
        ends = f"({condition.c}|((int32_t){c}>(int32_t)3))"
        return st, f"{c}=0;do{{{c}={c}+1;{join(body, 1)}}}while(!{ends});"

    # Texts

    def _st(self, body):
        loops = "".join(f"loop{n} : INT; " for n in range(1, self.loops + 1))
        lines = [f"{name} : {st_type};" for name, st_type, *_ in self.variables]
        statements = join(body, 0).replace("; ", ";\n")
        return (
            "FUNCTION_BLOCK Pulse VAR_INPUT step : INT; END_VAR VAR_OUTPUT n : INT; END_VAR\n"
            "VAR m : INT; END_VAR VAR_INPUT x : BOOL; END_VAR VAR zzEdge00000 : BOOL; END_VAR\n"
            "IF EDGEPOS(x) THEN n := n + step; END_IF m := m + 1;\nEND_FUNCTION_BLOCK\n"
            f"PROGRAM _CYCLIC {statements}\nEND_PROGRAM\n"
            "PROGRAM _INIT ref_int ACCESS ADR(int0); ref_udint ACCESS ADR(udint0); END_PROGRAM\n"
            f"VAR\n{chr(10).join(lines)}\n{loops}END_VAR\n"
        )

    def _c(self, body):
        return f"void cyclic_{self.name}(void){{\n{join(body, 1)}\n}}\n"


PULSE = """
static void pulse(uint32_t at) {
    uint8_t x = AT(uint8_t, at + 6), *edge = &AT(uint8_t, at + 7);
    if (x & ~*edge & 1 ? (*edge = x & 1, 1) : (*edge = x & 1, 0))
        AT(int16_t, at + 2) = AT(int16_t, at + 2) + AT(int16_t, at);
    AT(int16_t, at + 4) = AT(int16_t, at + 4) + 1;
}
"""


def join(statements, which):
    """One text of several statements."""
    return " ".join(each[which] for each in statements)


def c_file(programs):
    """The translations of several programs."""
    return HEAD + PULSE + "".join(program.c for program in programs)
