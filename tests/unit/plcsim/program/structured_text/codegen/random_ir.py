"""Random modules that keep to the rules of the intermediate representation on roots.

Segment ``program`` holds scalars (a root each), members that overlap each other (one root), an
array (one root), two instances of a block (a root each), and bytes of root 0, which pointers reach
and where data of another block may lie.
REAL and LREAL have places of their own: the bits of a NaN are not defined.
"""

from typing import get_args

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.operators import OPERATORS

SIZE = 1024
ZERO_ROOT = range(64)
INTEGERS = {"s8": 64, "u8": 65, "s16": 66, "u16": 68, "w32": 72, "w64": 80}
REALS = {"f32": 88, "f64": 96}
MEMBERS = range(112, 144)
INSTANCES = (144, 208)
INSTANCE_SIZE = 64
ARRAY = 272
ARRAY_SIZE = 2 * 256 + 8
STRINGS = (800, 832)
STRING_LENGTH = 30

ROOT = {"members": 20, "array": 21, 144: 22, 208: 23, 800: 24, 832: 25}
INTEGER_OPERATORS = [o for o in get_args(ir.BinaryOperator) if ("i32", o) in OPERATORS]
INTEGER_COMPARE = ["eq", "ne", "lt_s", "lt_u", "gt_s", "gt_u", "le_s", "le_u", "ge_s", "ge_u"]
REAL_COMPARE = ["eq", "ne", "lt", "gt", "le", "ge"]
NUMBERS = (0, 1, 2, 3, 5, 7, 8, 31, 127, 128, 255, 256, 32767, 65535, -1, -2, -128, 2**31, -(2**31))
REAL_NUMBERS = (0.0, -0.0, 1.0, -1.5, 0.1, 1e10, -3e9, 1e300, float("inf"), float("nan"))


class Maker:
    """Makes one module.

    Args:
        random: chooses.
    """

    def __init__(self, random):
        self.random = random
        self.segment = ir.Segment("program", SIZE)
        self.line = 1
        self.label = 0
        self.loops = []
        self.blocks = []
        self.locals = []
        self.parameters = []
        self.counters = set()
        self.this = False
        self.with_reals = False
        self.callable = []
        self.result = None

    def module(self):
        imports = {
            "b.FOREIGN": ir.Import("block", "FOREIGN", ir.Signature(("i32",), None)),
            "f.foreign": ir.Import("function", "foreign", ir.Signature(("i32", "f64"), "i32")),
        }
        functions = [
            self.function("F1", "function", ("i32", "i64"), "i32"),
            self.function("F2", "function", ("f64", "i32"), "f64"),
            self.function("GLOBAL_FB", "block", ("i32",), None),
            self.function("FB", "block", ("i32",), None),
            self.function("ACTION", "action", (), None),
            self.function("CYCLIC", "unit", (), None),
        ]
        functions[-1].exported = True
        return ir.Module("random", functions, imports, (self.segment,), ("Main.st",))

    def function(self, name, kind, parameters, result):
        self.this, self.result = kind == "block", result
        self.with_reals = name == "FB"
        self.parameters, self.locals, self.counters = list(parameters), [], set()
        body = self.body(3, self.random.randint(2, 7))
        if result:
            body.append(ir.Return(self.next_line(), self.value(result, 2)))
        self.callable.append(name)
        return ir.Function(name, kind, parameters, result, tuple(self.locals), body)

    def next_line(self):
        self.line += self.random.choice((0, 1, 1, 3, -1 if self.line > 5 else 1))
        return self.line

    def local(self, kind):
        self.locals.append(kind)
        return len(self.parameters) + len(self.locals) - 1

    def chance(self, percent):
        return self.random.randrange(100) < percent

    # places

    def integer_place(self, depth):
        """A place and its width, of an integer."""
        choice = self.random.randrange(8)
        width = self.random.choice(tuple(INTEGERS))
        size = ir.BYTES[width]
        if choice <= 3:
            return self.scalar(width, INTEGERS), width
        if choice == 4:
            offset = self.random.choice([MEMBERS[0], MEMBERS[0] + 4, MEMBERS[-1] + 1 - size])
            return ir.Place(self.segment, offset, ROOT["members"]), width
        if choice == 5:
            return self.element(depth), self.random.choice(("s16", "u16"))
        offset = self.random.choice((0, 4, len(ZERO_ROOT) - size))
        if choice == 6 or not depth:
            return ir.Place(self.segment, offset, 0), width
        index = ir.Binary("i32", "and", self.value("i32", depth - 1), ir.Const("i32", 15))
        base = ir.AddressOf(ir.Place(self.segment, 0, 0))
        return ir.Place(ir.Binary("i32", "add", base, index), offset % 40, 0), width

    def scalar(self, width, table):
        """A scalar of the program, or of the instance whose body this is."""
        order = list({**INTEGERS, **REALS}).index(width) + 1
        if self.this and self.chance(60) and (table is INTEGERS or self.with_reals):
            return ir.Place(ir.Local("i32", 0), table[width] - 64, 40 + order)
        return ir.Place(self.segment, table[width], order)

    def element(self, depth):
        base = ir.AddressOf(ir.Place(self.segment, ARRAY + 6, ROOT["array"]))
        index = ir.Load("i32", "u8", self.scalar("u8", INTEGERS))
        choice = self.random.randrange(4)
        if choice == 0 and depth:
            index = ir.Checked(self.value("i32", depth - 1), 256)
        elif choice == 1:
            index = ir.Binary("i32", "sub", index, ir.Const("i32", 3))
        elif choice == 2 and depth:
            index = ir.Binary("i32", "and", self.value("i32", depth - 1), ir.Const("i32", 255))
        scaled = ir.Binary("i32", *self.random.choice((("mul", index, ir.Const("i32", 2)),)))
        if self.chance(50):
            scaled = ir.Binary("i32", "shl", index, ir.Const("i32", 1))
        return ir.Place(ir.Binary("i32", "add", base, scaled), 0, ROOT["array"])

    # expressions

    def value(self, kind, depth):
        if kind in ("i32", "i64"):
            return self.integer(kind, depth)
        return self.real(kind, depth)

    def known_locals(self, kind):
        first = 1 if self.this else 0
        kinds = [*self.parameters, *self.locals]
        own = [i for i in range(first, len(kinds)) if i not in self.counters]
        return [i for i in own if kinds[i] == kind]

    def leaf(self, kind):
        locals_ = self.known_locals(kind)
        if locals_ and self.chance(30):
            return ir.Local(kind, self.random.choice(locals_))
        if kind in ("i32", "i64"):
            if self.chance(30):
                return ir.Const(kind, self.random.choice(NUMBERS))
            place, width = self.integer_place(0)
            return self.as_integer(ir.Load(ir.VALUE_TYPE[width], width, place), kind)
        if self.chance(30):
            return ir.Const(kind, self.random.choice(REAL_NUMBERS))
        return ir.Load(kind, kind, self.scalar(kind, REALS))

    def as_integer(self, value, kind):
        if value.type == kind:
            return value
        if kind == "i32":
            return ir.Convert("i32", "wrap_i64", value)
        return ir.Convert("i64", self.random.choice(("extend_i32_s", "extend_i32_u")), value)

    def integer(self, kind, depth):
        if not depth or self.chance(20):
            return self.leaf(kind)
        makers = (
            self.integer_load,
            self.integer_load,
            self.integer_operation,
            self.integer_operation,
            self.comparison,
            self.conversion,
            self.choice_of,
            self.call,
            self.sequence,
        )
        return self.as_integer(self.random.choice(makers)(kind, depth - 1), kind)

    def integer_load(self, _kind, depth):
        place, width = self.integer_place(depth)
        return ir.Load(ir.VALUE_TYPE[width], width, place)

    def integer_operation(self, kind, depth):
        if self.chance(15):
            operator = self.random.choice(("clz", "ctz", "popcnt"))
            return ir.Unary(kind, operator, self.value(kind, depth))
        operator = self.random.choice(INTEGER_OPERATORS)
        left, right = self.value(kind, depth), self.value(kind, depth)
        if "_" in operator and operator[:3] in ("div", "rem") and self.chance(80):
            right = ir.Binary(kind, "or", right, ir.Const(kind, 1))
        return ir.Binary(kind, operator, left, right)

    def comparison(self, _kind, depth):
        kind = self.random.choice(("i32", "i32", "i64", "f32", "f64"))
        operators = INTEGER_COMPARE if kind in ("i32", "i64") else REAL_COMPARE
        left, right = self.value(kind, depth), self.value(kind, depth)
        return ir.Compare(kind, self.random.choice(operators), left, right)

    def conversion(self, kind, depth):
        if self.chance(50):
            source = self.random.choice(("f32", "f64"))
            return ir.Convert(kind, f"trunc_{source}_s", self.value(source, depth))
        operator = self.random.choice(("extend8_s", "extend16_s"))
        return ir.Convert("i32", operator, self.value("i32", depth))

    def choice_of(self, kind, depth):
        node = self.random.choice((ir.Select, ir.IfExpression))
        condition = self.value("i32", depth)
        return node(kind, condition, self.value(kind, depth), self.value(kind, depth))

    def call(self, _kind, depth):
        choice = self.random.randrange(4)
        if choice == 0 and "F1" in self.callable:
            return ir.Call("i32", "F1", (self.value("i32", depth), self.value("i64", depth)))
        if choice == 1:
            return ir.Call("i32", "f.foreign", (self.value("i32", depth), self.value("f64", depth)))
        if choice == 2:
            return ir.Call("i32", "rt.string_compare", [self.string(s) for s in STRINGS])
        return self.leaf("i32")

    def sequence(self, kind, depth):
        return ir.StatementExpression(kind, self.body(0, 2), self.value(kind, depth))

    def real(self, kind, depth):
        if not depth or self.chance(20):
            return self.leaf(kind)
        choice = self.random.randrange(6)
        depth -= 1
        if choice == 0:
            operators = ("neg", "abs", "sqrt", "floor", "ceil", "trunc", "nearest")
            return ir.Unary(kind, self.random.choice(operators), self.value(kind, depth))
        if choice == 1:
            return self.to_real(kind, depth)
        if choice == 2:
            return self.choice_of(kind, depth)
        if choice == 3 and "F2" in self.callable and kind == "f64":
            return ir.Call("f64", "F2", (self.value("f64", depth), self.value("i32", depth)))
        left = self.value(kind, depth)
        if choice == 4:
            sign = ir.Const(kind, self.random.choice((-1.0, -0.0, 2.0)))
            return ir.Binary(kind, "copysign", left, sign)
        operator = self.random.choice(("add", "sub", "mul", "div", "min", "max"))
        return ir.Binary(kind, operator, left, self.value(kind, depth))

    def to_real(self, kind, depth):
        if self.chance(40):
            other, operator = ("f64", "demote_f64") if kind == "f32" else ("f32", "promote_f32")
            return ir.Convert(kind, operator, self.value(other, depth))
        source = self.random.choice(("i32", "i64"))
        sign = self.random.choice("su")
        return ir.Convert(kind, f"convert_{source}_{sign}", self.value(source, depth))

    def string(self, start):
        return ir.AddressOf(ir.Place(self.segment, start, ROOT[start]))

    # statements

    def body(self, depth, count):
        return [self.statement(depth) for _ in range(count)]

    def statement(self, depth):
        simple = (
            self.store,
            self.store,
            self.store,
            self.real_store,
            self.set_local,
            self.evaluate,
        )
        nested = (self.if_, self.if_, self.switch, self.block, self.loop, self.loop, self.leave)
        makers = simple + nested + (self.bytes,) if depth else simple
        return self.random.choice(makers)(depth)

    def store(self, depth):
        line = self.next_line()
        place, width = self.integer_place(min(depth, 1))
        return ir.Store(line, width, place, self.value(ir.VALUE_TYPE[width], 2))

    def real_store(self, _depth):
        width = self.random.choice(("f32", "f64"))
        line = self.next_line()
        return ir.Store(line, width, self.scalar(width, REALS), self.value(width, 2))

    def set_local(self, _depth):
        line = self.next_line()
        kind = self.random.choice(("i32", "i64", "f32", "f64"))
        value = self.value(kind, 2)
        known = self.known_locals(kind)
        index = self.random.choice(known) if known and self.chance(60) else self.local(kind)
        return ir.SetLocal(line, index, value)

    def evaluate(self, _depth):
        line = self.next_line()
        choice = self.random.randrange(6)
        if choice == 5 and "GLOBAL_FB" in self.callable:
            return ir.Evaluate(line, ir.Call(None, "GLOBAL_FB", (self.global_instance(),)))
        instance = self.random.choice(INSTANCES)
        data = ir.AddressOf(ir.Place(self.segment, instance, ROOT[instance]))
        if choice == 0 and "FB" in self.callable:
            return ir.Evaluate(line, ir.Call(None, "FB", (data,)))
        if choice == 1 and "FB" in self.callable:  # what a block calls knows no instance of it
            return ir.Evaluate(line, ir.Call(None, "b.FOREIGN", (data,)))
        if choice == 2 and "ACTION" in self.callable:
            return ir.Evaluate(line, ir.Call(None, "ACTION", ()))
        if choice == 3:
            return ir.Evaluate(line, self.value("i32", 2))
        strings = [self.string(s) for s in self.random.sample(STRINGS, 2)]
        limit = ir.Const("i32", self.random.choice((0, 3, STRING_LENGTH - 1)))
        return ir.Evaluate(line, ir.Call(None, "rt.string_assign", (*strings, limit)))

    def global_instance(self):
        """The address of a block's data that lies in root 0, so that pointers reach it."""
        address = ir.AddressOf(ir.Place(self.segment, 0, 0))
        step = ir.Binary("i32", "and", self.value("i32", 1), ir.Const("i32", 4))
        return ir.Binary("i32", "add", address, step) if self.chance(50) else address

    def bytes(self, _depth):
        line = self.next_line()
        root = self.random.choice((0, ROOT["array"]))
        start = 0 if root == 0 else ARRAY
        target, source = (
            ir.AddressOf(ir.Place(self.segment, start + self.random.randrange(20), root))
            for _ in range(2)
        )
        count = ir.Const("i32", self.random.choice((0, 1, 7, 16, 40)))
        if self.chance(30):
            count = ir.Binary("i32", "and", self.value("i32", 1), ir.Const("i32", 31))
        if self.chance(50):
            return ir.CopyBytes(line, target, source, count)
        value = ir.Const("i32", 0) if self.chance(50) else self.value("i32", 1)
        return ir.FillBytes(line, target, value, count)

    def if_(self, depth):
        line = self.next_line()
        arms = [
            ir.Arm(self.next_line(), self.value("i32", 2), self.body(depth - 1, 2))
            for _ in range(self.random.choice((1, 1, 2, 3)))
        ]
        other = self.body(depth - 1, self.random.choice((0, 0, 1, 2)))
        return ir.If(line, arms, other)

    def switch(self, depth):
        line = self.next_line()
        ends = sorted(
            self.random.sample((-(2**31), -5, -1, 0, 1, 2, 3, 4, 9, 200, 70000, 2**31 - 1), 8)
        )
        ranges = [(ends[i], ends[i + 1] - 1) for i in range(7)]
        ranges = [(low, high if self.chance(50) else low) for low, high in ranges]
        if self.chance(50):
            ranges = [(n, n) for n in range(2, 9)]
        self.random.shuffle(ranges)
        cut = self.random.randint(1, 6)
        kept = self.random.choice((ranges[:cut], ranges))
        cases = [
            ir.Case(self.next_line(), ranges_, self.body(depth - 1, 1))
            for ranges_ in (kept[::2], kept[1::2])
            if ranges_
        ]
        selector = self.value("i32", 2)
        if self.chance(60):
            selector = ir.Binary("i32", "and", selector, ir.Const("i32", 7))
        return ir.Switch(line, selector, cases, self.body(depth - 1, self.random.choice((0, 1))))

    def block(self, depth):
        line = self.next_line()
        self.label += 1
        label = self.label
        self.blocks.append(label)
        body = self.body(depth - 1, 3)
        self.blocks.pop()
        return ir.Block(line, label, body)

    def loop(self, depth):
        """A loop that its own local ends, as FOR, WHILE, REPEAT and others look when lowered."""
        line = self.next_line()
        self.label += 1
        label, passes = self.label, self.local("i32")
        self.counters.add(passes)
        count = ir.Local("i32", passes)
        step = ir.SetLocal(line, passes, ir.Binary("i32", "add", count, ir.Const("i32", 1)))
        enough = ir.Compare("i32", "ge_s", count, ir.Const("i32", self.random.choice((0, 1, 4))))
        tests = self.integer_place(0)
        wide = ir.Load(ir.VALUE_TYPE[tests[1]], tests[1], tests[0])
        condition = ir.Binary("i32", "or", enough, self.as_integer(wide, "i32"))
        leave = ir.Break(self.next_line(), label)
        test = ir.If(self.next_line(), [ir.Arm(self.next_line(), condition, [leave])])
        bound = ir.If(line, [ir.Arm(line, enough, [ir.Break(line, label)])])
        self.loops.append(label)
        inside = self.body(depth - 1, self.random.randint(1, 4))
        self.loops.pop()
        start = ir.SetLocal(line, passes, ir.Const("i32", 0))
        shapes = (
            [test, step, *inside],
            [step, bound, *inside, test],
            [step, bound, *inside],
            [step, bound, *inside, bound],
        )
        loop = ir.Loop(line, label, self.random.choice(shapes))
        if self.loops == [] and self.chance(50):
            return loop
        self.label += 1
        return ir.Block(line, self.label, [start, loop])

    def leave(self, _depth):
        line = self.next_line()
        labels = [(ir.Break, label) for label in self.loops + self.blocks]
        labels += [(ir.Continue, label) for label in self.loops]
        if not labels or self.chance(10):
            value = self.value(self.result, 1) if self.result else None
            leave = ir.Return(line, value)
        else:
            kind, label = self.random.choice(labels)
            leave = kind(line, label)
        if self.chance(80):
            return ir.If(line, [ir.Arm(line, self.value("i32", 1), [leave])])
        return leave
