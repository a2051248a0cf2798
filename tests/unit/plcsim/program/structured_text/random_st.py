"""Random statements and values in Structured Text, each with its translation to C.

The translation says what Automation Studio's compiler makes of a program (docs/compliance.md): it
is written down here a second time, as text, and shares nothing with our compiler.
"""

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
    "TIME": ("int32_t", 4, "s"),
    "Colour": ("int32_t", 4, "s"),
}
"""Elementary types, and an enumeration: type in C, bytes, signed or unsigned or floating."""

INTEGERS = ["SINT", "USINT", "INT", "UINT", "DINT", "UDINT"]
SIGNED = ["SINT", "INT", "DINT"]
UNSIGNED = ["USINT", "UINT", "UDINT"]
REALS = ["REAL", "LREAL"]
SIZES = {name: size for name, (_, size, _) in TYPES.items()}
COLOURS = {"RED": 0, "GREEN": 5, "BLUE": 6}


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


def compared_as(type_name):
    """The C type that both sides of a comparison are cast to."""
    return "uint32_t" if TYPES[type_name][2] == "u" else "int32_t"


class Term:
    """A value: its type (None for a whole number that takes any), its two texts."""

    def __init__(self, type_name, st, c):
        self.type = type_name
        self.st = st
        self.c = c


class Body:
    """Statements of one body, over what it knows.

    Attributes:
        places: variables by type, each its two texts, or a function that gives them for indices.
        strings: (ST, C address, length).
        aggregates: (ST, C address, bytes) of variables that are copied whole, by type.
        references: (ST, C of the address in it, type that it refers to).
        blocks: (ST, C address, inputs as (name, type, C offset), name of the block).
        functions: (name, result, types of the parameters).
        actions: (ST name, C name).
        loops: variables for loops that are left, in both texts.
        inside: whether a loop is around.
        edges: how many edges were written, None where none may be.
        can_return: whether RETURN may be written; C goes to ``out``.
        is_standard: the translation is what IEC 61131-3 makes of it: results keep the width of
            their type, AND and OR leave out what does not matter, a limit is evaluated once.
    """

    is_standard = False

    def __init__(self, chance):
        self.random = chance
        self.places = {}
        self.strings = []
        self.aggregates = {}
        self.references = []
        self.blocks = []
        self.functions = []
        self.actions = []
        self.loops = []
        self.inside = False
        self.edges = None
        self.can_return = False

    def know(self, type_name, st, c):
        self.places.setdefault(type_name, []).append((st, c))

    def pick(self, *choices):
        return self.random.choice(choices)

    def cut(self, type_name, c):
        """The C of a result in its type."""
        if self.is_standard and SIZES[type_name] < 4:
            return f"(({TYPES[type_name][0]})({c}))"
        return c

    def place(self, type_name):
        """A variable, a member or an element."""
        found = self.random.choice(self.places[type_name])
        return Term(type_name, *(found(self) if callable(found) else found))

    def index(self, low, count):
        """An index within bounds: its two texts, the one of C counted from 0."""
        if self.random.random() < 0.5:
            number = self.random.randrange(count)
            return str(low + number), str(number)
        if self.random.random() < 0.3:
            a = self.place("USINT")
            return f"{a.st} MOD {count} + ({low})", f"({a.c}%{count})"
        a = self.place(self.random.choice(SIGNED))
        st = f"(({a.st} MOD {count}) + {count}) MOD {count} + ({low})"
        return st, f"(({a.c}%{count}+{count})%{count})"

    # Values

    def value(self, type_name, depth=0):
        """A value of a type, or of one that goes into it by itself."""
        if type_name == "BOOL":
            return self.truth(depth)
        if type_name == "TIME":
            return self.time(depth)
        if type_name == "Colour":
            return self.colour()
        return self.real(depth, type_name) if type_name in REALS else self.integer(depth)

    def typed(self, type_name, depth=0):
        """A value that is no bare number, for that might not fit."""
        found = self.value(type_name, depth)
        return self.place("INT") if found.type is None else found

    def colour(self):
        if self.random.random() < 0.4:
            return self.place("Colour")
        name = self.random.choice([*COLOURS])
        return Term("Colour", name, str(COLOURS[name]))

    def time(self, depth):
        kind = self.random.random()
        if depth > 3 or kind < 0.5:
            return self.place("TIME")
        if kind < 0.6:
            number = self.random.randrange(5000)
            return Term("TIME", f"T#{number}ms", str(number))
        if kind < 0.75:
            a = self.place("DINT")
            return Term("TIME", f"DINT_TO_TIME({a.st})", a.c)
        a, b, sign = self.time(depth + 1), self.time(depth + 1), self.pick("+", "-")
        return Term("TIME", f"({a.st} {sign} {b.st})", f"({a.c}{sign}{b.c})")

    def literal(self):
        number = self.pick(0, 1, 2, 3, 5, 7, 10, 100, 200, 1000, 40000, 70000, 2000000000)
        shown = str(number) if self.random.random() < 0.8 else f"16#{number:X}"
        return Term(None, shown, str(number))

    def integer(self, depth):
        kind = self.random.random()
        if depth > 3 or kind < 0.3:
            return self.place(self.random.choice(INTEGERS))
        if kind < 0.4:
            return self.literal()
        if kind < 0.7:
            return self.arithmetic(depth)
        makers = [
            self.cast,
            self.rounded,
            self.absolute,
            self.negative,
            self.selected,
            self.shifted,
        ]
        makers += [self.extreme, self.limited, self.multiplexed, self.elapsed, self.counted]
        if self.functions:
            makers += [self.called] * 3
        return self.random.choice(makers)(depth)

    def numbers(self, depth, make):
        a, b = make(depth + 1), make(depth + 1)
        if a.type is None and b.type is None:
            a = self.place(self.random.choice(INTEGERS))
        return a, b, self.common(a, b)

    def common(self, a, b):
        """The type of an operation: a number takes that of the other, or one that holds it."""
        typed, bare = (a, b) if b.type is None else (b, a)
        if bare.type is not None:
            return common(a.type, b.type)
        _, size, sign = TYPES[typed.type]
        if not self.is_standard or int(bare.c) < 1 << 8 * size - (sign == "s"):
            return typed.type
        wider = next(each for each in SIGNED if int(bare.c) < 1 << 8 * SIZES[each] - 1)
        return common(typed.type, wider)

    def arithmetic(self, depth):
        operator = self.pick("+", "-", "*", "/", "MOD", "AND", "OR", "XOR")
        if operator in ("/", "MOD"):
            return self.division(depth, operator)
        a, b, type_name = self.numbers(depth, self.integer)
        sign = {"AND": "&", "OR": "|", "XOR": "^"}.get(operator, operator)
        c = self.cut(type_name, f"({a.c}{sign}{b.c})")
        return Term(type_name, f"({a.st} {operator} {b.st})", c)

    def division(self, depth, operator):
        """Division by what is not 0, MOD by what may be; never the smallest DINT by -1."""
        a = self.integer(depth + 1)
        if a.type is None:
            a = self.place("INT")
        number = self.pick("1", "2", "3", "7", "100")
        b, type_name = Term(None, number, number), a.type
        if self.random.random() < 0.4:
            b = self.place(self.random.choice(INTEGERS if operator == "MOD" else ["UINT"]))
            if operator == "/":
                b = Term("UINT", f"({b.st} MOD 9 + 1)", f"({b.c}%9+1)")
            elif b.type in SIGNED:
                b = Term(b.type, f"ABS({b.st} / 2)", f"({b.c}/2<0?-({b.c}/2):{b.c}/2)")
            type_name = self.common(a, b)
        elif self.is_standard:
            type_name = self.common(a, b)
        cast = compared_as(type_name)
        sign = {"/": "/", "MOD": "%"}[operator]
        quotient = f"((({cast})({a.c})){sign}(({cast})({b.c})))"
        c = f"(({b.c})==0?0:{quotient})" if operator == "MOD" else quotient
        return Term(type_name, f"({a.st} {operator} {b.st})", self.cut(type_name, c))

    def cast(self, _depth):
        target = self.random.choice(INTEGERS)
        source = self.place(self.random.choice([*INTEGERS, "BOOL"]))
        text = f"(({TYPES[target][0]})({source.c}))"
        return Term(target, f"{source.type}_TO_{target}({source.st})", text)

    def rounded(self, _depth):
        target = self.pick("SINT", "INT", "DINT", "USINT", "UINT")
        source = self.place(self.random.choice(REALS))
        x = f"({source.c})"
        text = f"(({TYPES[target][0]})({x}>=0.0?{x}+0.5:{x}-0.5))"
        if self.is_standard:
            text = f"(({TYPES[target][0]})(int32_t)rint({x}))"
        return Term(target, f"{source.type}_TO_{target}({source.st})", text)

    def absolute(self, _depth):
        """ABS, but never of the smallest DINT: gcc takes what it gives there for above 0."""
        a = self.place(self.random.choice(SIGNED))
        if a.type == "DINT":
            a = Term("DINT", f"({a.st} / 2)", f"({a.c}/2)")
        return Term(a.type, f"ABS({a.st})", self.cut(a.type, f"(({a.c})<0?-({a.c}):({a.c}))"))

    def negative(self, _depth):
        a = self.place(self.random.choice(SIGNED))
        return Term(a.type, f"(-{a.st})", self.cut(a.type, f"(-{a.c})"))

    def selected(self, depth):
        type_name = self.random.choice(INTEGERS)
        g, a, b = self.truth(depth + 2), self.place(type_name), self.place(type_name)
        return Term(type_name, f"SEL({g.st}, {a.st}, {b.st})", f"(({g.c})?({b.c}):({a.c}))")

    def shifted(self, _depth):
        a = self.place(self.random.choice(UNSIGNED))
        c_type, size, _ = TYPES[a.type]
        bits = 8 * size
        number = self.random.randrange(1, bits)
        name = self.pick("SHL", "SHR", "ROL", "ROR")
        left, right = f"({a.c}<<{number})", f"({a.c}>>{number})"
        c = {
            "SHL": left,
            "SHR": right,
            "ROL": f"({left}|({a.c}>>{bits - number}))",
            "ROR": f"({right}|({a.c}<<{bits - number}))",
        }[name]
        return Term(a.type, f"{name}({a.st}, {number})", f"(({c_type}){c})")

    def extreme(self, _depth):
        type_name = self.random.choice(INTEGERS)
        a, b, name = self.place(type_name), self.place(type_name), self.pick("MIN", "MAX")
        sign = "<" if name == "MIN" else ">"
        return Term(type_name, f"{name}({a.st}, {b.st})", f"(({a.c}){sign}({b.c})?({a.c}):({b.c}))")

    def limited(self, _depth):
        a = self.place(self.random.choice(SIGNED))
        low, high = self.pick(-100, 0, 5), self.pick(7, 100)
        c = f"(({a.c})<{low}?{low}:({a.c})>{high}?{high}:({a.c}))"
        return Term(a.type, f"LIMIT({low}, {a.st}, {high})", c)

    def multiplexed(self, _depth):
        type_name = self.random.choice(INTEGERS)
        k, a, b, c = self.place("USINT"), *(self.place(type_name) for _ in range(3))
        text = f"({k.c}%3==0?({a.c}):{k.c}%3==1?({b.c}):({c.c}))"
        return Term(type_name, f"MUX({k.st} MOD 3, {a.st}, {b.st}, {c.st})", text)

    def elapsed(self, depth):
        a = self.time(depth + 2)
        return Term("DINT", f"TIME_TO_DINT({a.st})", f"((int32_t)({a.c}))")

    def counted(self, _depth):
        """SIZEOF, which is a bare number in C, or a colour as a number."""
        if not self.aggregates or self.random.random() < 0.3:
            a = self.place("Colour")
            return Term("DINT", f"{a.st}", a.c)
        name, _, size = self.random.choice(self.aggregates[self.random.choice([*self.aggregates])])
        return Term(None, f"SIZEOF({name})", str(size))

    def called(self, depth):
        name, result, parameters = self.random.choice(self.functions)
        arguments = [self.typed(each, depth + 1) for _, each in parameters]
        if self.random.random() < 0.5:
            st = ", ".join(each.st for each in arguments)
        else:
            named = zip(parameters, arguments, strict=True)
            st = ", ".join(f"{parameter} := {each.st}" for (parameter, _), each in named)
        return Term(result, f"{name}({st})", f"{name}({','.join(each.c for each in arguments)})")

    def real(self, depth, wanted="LREAL"):
        kind = self.random.random()
        types = ["REAL"] if wanted == "REAL" else REALS
        if depth > 3 or kind < 0.4:
            return self.place(self.random.choice(types))
        if kind < 0.55:
            number = self.pick("0.1", "1.5", "2.0", "1000.25")
            a, operator = self.place("REAL"), self.pick("+", "-", "*", "/")
            suffix = "f" if self.is_standard else ""
            c = f"({a.c}{operator}{number}{suffix})"
            return Term("REAL", f"({a.st} {operator} {number})", c)
        if kind < 0.65:
            return self.converted(wanted)
        a = self.place(self.random.choice(types))
        b = self.pick(self.integer, lambda d: self.real(d, wanted))(depth + 2)
        operator = self.pick("+", "-", "*")
        type_name = common(a.type, b.type or a.type)
        return Term(type_name, f"({a.st} {operator} {b.st})", f"({a.c}{operator}{b.c})")

    def converted(self, wanted):
        target = "REAL" if wanted == "REAL" else self.random.choice(REALS)
        a = self.place(self.random.choice([*INTEGERS, *REALS]))
        if a.type == target:
            return a
        return Term(target, f"{a.type}_TO_{target}({a.st})", f"(({TYPES[target][0]})({a.c}))")

    # Truth values

    def truth(self, depth):
        kind = self.random.random()
        if depth > 3 or kind < 0.25:
            return self.place("BOOL")
        if kind < 0.55:
            return self.comparison(depth)
        if kind < 0.65:
            a = self.truth(depth + 1)
            return Term("BOOL", f"(NOT {a.st})", f"({a.c}^1)")
        if kind < 0.73:
            return self.bit()
        if kind < 0.79 and self.strings:
            return self.strings_compared()
        if kind < 0.84 and self.edges is not None:
            return self.edge()
        a, b, operator = self.truth(depth + 1), self.truth(depth + 1), self.pick("AND", "OR", "XOR")
        sign = {"AND": "&", "OR": "|", "XOR": "^"}[operator]
        if self.is_standard and sign != "^":
            sign *= 2
        return Term("BOOL", f"({a.st} {operator} {b.st})", f"({a.c}{sign}{b.c})")

    def comparison(self, depth):
        operator = self.pick("=", "<>", "<", ">", "<=", ">=")
        sign = {"=": "==", "<>": "!="}.get(operator, operator)
        kind = self.random.random()
        if kind < 0.35:
            make = {0: self.real, 1: self.time, 2: lambda _: self.colour()}[int(kind * 10) % 3]
            a, b = make(depth + 1), make(depth + 1)
            return Term("BOOL", f"({a.st} {operator} {b.st})", f"({a.c}{sign}{b.c})")
        a, b, type_name = self.numbers(depth, self.integer)
        cast = compared_as(type_name)
        c = f"((({cast})({a.c})){sign}(({cast})({b.c})))"
        return Term("BOOL", f"({a.st} {operator} {b.st})", c)

    def bit(self):
        a = self.place(self.random.choice(INTEGERS))
        number = self.random.randrange(8 * SIZES[a.type])
        return Term("BOOL", f"{a.st}.{number}", f"(({a.c}>>{number})&1)")

    def edge(self):
        a, name = self.place("BOOL"), self.pick("EDGEPOS", "EDGENEG", "EDGE")
        self.edges += 1
        edge = f"edge{self.edges}"
        fires = {"EDGEPOS": f"{a.c}&~{edge}&1", "EDGENEG": f"~{a.c}&{edge}&1"}
        fires["EDGE"] = f"({a.c}^{edge})&1"
        c = f"({{static uint8_t {edge};int f={fires[name]};{edge}={a.c}&1;f;}})"
        return Term("BOOL", f"{name}({a.st})", c)

    def strings_compared(self):
        (a, c, _), (b, d, _) = self.random.choice(self.strings), self.random.choice(self.strings)
        operator = self.pick("=", "<>", "<", ">=")
        sign = {"=": "==", "<>": "!="}.get(operator, operator)
        return Term("BOOL", f"({a} {operator} {b})", f"(string_order({c},{d}){sign}0)")

    # Statements, each as its two texts

    def statement(self, depth=0):
        makers = [self.assignment] * 8 + [self.bit_assignment, self.chained]
        makers += [self.string_assignment] * bool(self.strings) + [self.leave] * self.inside
        makers += [self.copy] * bool(self.aggregates) + [self.link] * 2 * bool(self.references)
        makers += [self.run_block] * 2 * bool(self.blocks) + [self.act] * bool(self.actions)
        makers += [self.return_] * self.can_return
        if depth < 3:
            makers += [self.if_, self.if_, self.case, self.case_of_colours]
            makers += [self.for_, self.repeat, self.while_] * bool(self.loops)
        return self.random.choice(makers)(depth)

    def statements(self, depth, most=3):
        return [self.statement(depth + 1) for _ in range(self.random.randint(1, most))]

    def assignment(self, _depth):
        type_name = self.random.choice([each for each in TYPES if each in self.places])
        target, value = self.place(type_name), self.typed(type_name)
        return f"{target.st} := {value.st};", f"{target.c}={value.c};"

    def chained(self, _depth):
        """A chain; the place of its second target may read what the first one is."""
        first, second = self.random.choice([("DINT", "INT"), ("INT", "SINT"), ("UDINT", "USINT")])
        a, b, value = self.place(first), self.place(second), self.typed(second)
        c_type = TYPES[second][0]
        text = f"{{{c_type} v={value.c};{c_type}*q=&{b.c};*q=v;{a.c}=v;}}"
        return f"{a.st} := {b.st} := {value.st};", text

    def bit_assignment(self, _depth):
        target = self.place(self.random.choice(INTEGERS))
        number, value = self.random.randrange(8 * SIZES[target.type]), self.truth(1)
        mask = f"{1 << number}u"
        text = f"{{int v={value.c}; {target.c}=({target.c}&~{mask})|((v&1)?{mask}:0u);}}"
        return f"{target.st}.{number} := {value.st};", text

    def string_assignment(self, _depth):
        name, target, length = self.random.choice(self.strings)
        if self.random.random() < 0.5:
            text = self.pick("", "a", "hello", "Hello World!", "0123456789abcdef")
            limit = min(length, len(text))
            return f"{name} := '{text}';", f'string_assign({target},"{text}",{limit});'
        other, source, size = self.random.choice(self.strings)
        return f"{name} := {other};", f"string_assign({target},{source},{min(length, size)});"

    def copy(self, _depth):
        """Copy a STRUCT or an ARRAY."""
        alike = self.aggregates[self.random.choice([*self.aggregates])]
        (a, c, size), (b, d, _) = self.random.choice(alike), self.random.choice(alike)
        return f"{a} := {b};", f"memmove((void*)({c}),(void*)({d}),{size});"

    def link(self, _depth):
        """Set a reference; to a 32-bit integer ``:=`` writes through it."""
        name, c, type_name = self.random.choice(self.references)
        if type_name not in TYPES:
            target, address, _ = self.random.choice(self.aggregates[type_name])
            if target == name:
                return self.assignment(0)
            return (
                f"{name} {self.pick('ACCESS', ':=')} ADR({target});",
                f"{c}=(uint32_t)({address});",
            )
        target = self.place(type_name)
        if SIZES[type_name] == 4 and self.random.random() < 0.3:
            c_type = TYPES[type_name][0]
            return f"{name} := ADR({target.st});", f"*({c_type}*){c}=(uint32_t)&({target.c});"
        word = "ACCESS" if SIZES[type_name] == 4 else self.pick("ACCESS", ":=")
        return f"{name} {word} ADR({target.st});", f"{c}=(uint32_t)&({target.c});"

    def run_block(self, _depth):
        name, address, inputs, block = self.random.choice(self.blocks)
        chosen = [each for each in inputs if self.random.random() < 0.8]
        values = [self.typed(type_name, 1) for _, type_name, _ in chosen]
        named = zip(chosen, values, strict=True)
        st = ", ".join(f"{parameter} := {value.st}" for (parameter, _, _), value in named)
        c = "".join(
            f"{at(type_name, f'{address}+{offset}')}={value.c};"
            for (_, type_name, offset), value in zip(chosen, values, strict=True)
        )
        return f"{name}({st});", f"{c}{block}({address});"

    def act(self, _depth):
        st, c = self.random.choice(self.actions)
        return f"{st};", f"{c}();"

    def leave(self, _depth):
        condition, (st, c) = self.truth(2), self.pick(("EXIT", "break"), ("CONTINUE", "continue"))
        return f"IF {condition.st} THEN {st}; END_IF", f"if({condition.c}){{{c};}}"

    def return_(self, _depth):
        condition = self.comparison(2)
        return f"IF {condition.st} THEN RETURN; END_IF", f"if({condition.c})goto out;"

    def if_(self, depth):
        condition, then, other = self.truth(1), self.statements(depth), self.statements(depth)
        second, more = self.truth(1), self.statements(depth)
        st = f"IF {condition.st} THEN {join(then, 0)} ELSIF {second.st} THEN {join(more, 0)} "
        c = f"if({condition.c}){{{join(then, 1)}}}else if({second.c}){{{join(more, 1)}}}"
        return f"{st}ELSE {join(other, 0)} END_IF", f"{c}else{{{join(other, 1)}}}"

    def case(self, depth):
        selector = self.place(self.random.choice(INTEGERS))
        labels = self.random.sample(range(-3, 8), 3)
        first, second, other = (self.statements(depth) for _ in range(3))
        st = (
            f"CASE {selector.st} OF {labels[0]}, {labels[1]}: {join(first, 0)} "
            f"10..99: {join(second, 0)} ELSE {join(other, 0)} END_CASE"
        )
        c_type = compared_as(selector.type if selector.type == "UDINT" else "DINT")
        c = (
            f"{{{c_type} x={selector.c};if(x=={labels[0]}||x=={labels[1]}){{{join(first, 1)}}}"
            f"else if(x>=10&&x<=99){{{join(second, 1)}}}else{{{join(other, 1)}}}}}"
        )
        return st, c

    def case_of_colours(self, depth):
        selector, (red, blue) = self.place("Colour"), (self.statements(depth) for _ in range(2))
        st = f"CASE {selector.st} OF RED: {join(red, 0)} BLUE: {join(blue, 0)} END_CASE"
        c = f"if(x==0){{{join(red, 1)}}}else if(x==6){{{join(blue, 1)}}}"
        return st, f"{{int32_t x={selector.c};{c}}}"

    # Loops

    def for_(self, depth):
        name, c = self.loops.pop()
        first, last = self.random.randint(-3, 3), self.random.randint(-3, 6)
        step = self.pick(1, 1, 2, -1)
        sign = "<=" if step > 0 else ">="
        limit = Term("INT", str(last), str(last))
        if step > 0 and self.random.random() < 0.3:
            limit = self.place("USINT")
            cast = "" if self.is_standard else "(uint32_t)"
            limit = Term("INT", f"{limit.st} MOD 5", f"({cast}{limit.c}%{cast}5)")
        body = self._inside(depth)
        st = f"FOR {name} := {first} TO {limit.st} BY {step} DO {join(body, 0)} END_FOR"
        before, kept = ("", limit.c)
        if self.is_standard:
            before, kept = f"int32_t limit={limit.c};", "limit"
        loop = f"for({c}={first};{c}{sign}{kept};{c}+={step}){{{join(body, 1)}}}"
        return st, f"{{{before}{loop}}}"

    def repeat(self, depth):
        name, c = self.loops.pop()
        body, condition = self._inside(depth), self.truth(2)
        st = (
            f"{name} := 0; REPEAT {name} := {name} + 1; {join(body, 0)} "
            f"UNTIL {condition.st} OR {name} > 3 END_REPEAT"
        )
        sign = "||" if self.is_standard else "|"
        ends = f"({condition.c}{sign}((int32_t){c}>(int32_t)3))"
        return st, f"{c}=0;do{{{c}={c}+1;{join(body, 1)}}}while(!{ends});"

    def while_(self, depth):
        name, c = self.loops.pop()
        condition, body = self.truth(2), self._inside(depth)
        st = (
            f"{name} := 0; WHILE {condition.st} AND {name} < 4 DO {name} := {name} + 1; "
            f"{join(body, 0)} END_WHILE"
        )
        sign = "&&" if self.is_standard else "&"
        goes_on = f"({condition.c}{sign}((int32_t){c}<(int32_t)4))"
        return st, f"{c}=0;while({goes_on}){{{c}={c}+1;{join(body, 1)}}}"

    def _inside(self, depth):
        before, self.inside = self.inside, True
        found = self.statements(depth)
        self.inside = before
        return found


def at(type_name, address):
    """What lies at an address, in C."""
    return f"(*({TYPES[type_name][0]}*)({address}))"


def join(statements, which):
    """One text of several statements."""
    return " ".join(each[which] for each in statements)
