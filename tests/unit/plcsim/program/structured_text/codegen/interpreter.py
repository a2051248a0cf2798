"""The meaning of the intermediate representation, said a second time and as plainly as can be.

Values of i32 and i64 are unsigned numbers here.
"""

import math
import struct

from plcsim.core.memory import FIRST
from plcsim.program.structured_text import ir

BITS = {"i32": 32, "i64": 64}


class TrapError(Exception):
    """The program ends; the argument says why."""


class LeaveError(Exception):
    def __init__(self, label):
        self.label = label


class AgainError(Exception):
    def __init__(self, label):
        self.label = label


class BackError(Exception):
    def __init__(self, value):
        self.value = value


def signed(value, kind):
    bits = BITS[kind]
    return value - (value >> (bits - 1) << bits)


def wrap(value, kind):
    return value & ((1 << BITS[kind]) - 1)


def single(value):
    """The nearest REAL."""
    try:
        return struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)


def divided(a, b):
    if b == 0:
        nothing = a == 0 or math.isnan(a)
        return math.nan if nothing else math.copysign(math.inf, a) * math.copysign(1, b)
    try:
        return a / b
    except OverflowError:
        return math.copysign(math.inf, a) * math.copysign(1, b)


def least(a, b):
    if math.isnan(a) or math.isnan(b):
        return math.nan
    return min(a, b, key=lambda x: (x, math.copysign(1, x)))


def most(a, b):
    if math.isnan(a) or math.isnan(b):
        return math.nan
    return max(a, b, key=lambda x: (x, math.copysign(1, x)))


def whole(how):
    def rounded(a):
        return a if not math.isfinite(a) else math.copysign(float(how(a)), a)

    return rounded


def product(a, b):
    if (math.isinf(a) and b == 0) or (a == 0 and math.isinf(b)):
        return math.nan
    return a * b


def total(a, b):
    if math.isinf(a) and math.isinf(b) and a != b:
        return math.nan
    return a + b


REAL_BINARY = {
    "add": total,
    "sub": lambda a, b: total(a, -b),
    "mul": product,
    "div": divided,
    "min": least,
    "max": most,
    "copysign": math.copysign,
}
REAL_UNARY = {
    "neg": lambda a: -a,
    "abs": math.fabs,
    "sqrt": lambda a: math.sqrt(a) if a >= 0 else math.nan,
    "floor": whole(math.floor),
    "ceil": whole(math.ceil),
    "trunc": whole(math.trunc),
    "nearest": whole(round),
}
COMPARE = {
    "eq": lambda a, b: a == b,
    "ne": lambda a, b: a != b,
    "lt": lambda a, b: a < b,
    "gt": lambda a, b: a > b,
    "le": lambda a, b: a <= b,
    "ge": lambda a, b: a >= b,
}


def quotient(a, b, kind):
    if b == 0:
        raise TrapError("division by zero")
    result = abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
    if result == 1 << (BITS[kind] - 1) and a < 0:
        raise TrapError("integer overflow")
    return result


def remainder(a, b):
    if b == 0:
        raise TrapError("division by zero")
    return abs(a) % abs(b) * (-1 if a < 0 else 1)


def shifted(a, count, kind, operator):
    bits = BITS[kind]
    count %= bits
    if operator == "shl":
        return a << count
    if operator == "shr_u":
        return a >> count
    if operator == "shr_s":
        return signed(a, kind) >> count
    if operator == "rotr":
        count = (bits - count) % bits
    return a << count | a >> (bits - count)


def integer_binary(operator, a, b, kind):
    plain = {
        "add": a + b,
        "sub": a - b,
        "mul": a * b,
        "and": a & b,
        "or": a | b,
        "xor": a ^ b,
    }
    if operator in plain:
        return plain[operator]
    if operator == "div_s":
        return quotient(signed(a, kind), signed(b, kind), kind)
    if operator == "rem_s":
        return remainder(signed(a, kind), signed(b, kind))
    if operator == "div_u":
        return quotient(a, b, kind)
    if operator == "rem_u":
        return remainder(a, b)
    return shifted(a, b, kind, operator)


def integer_unary(operator, a, kind):
    bits = BITS[kind]
    if operator == "popcnt":
        return a.bit_count()
    if operator == "clz":
        return bits - a.bit_length()
    return bits if a == 0 else (a & -a).bit_length() - 1


def extended(a, bits):
    a &= (1 << bits) - 1
    return a - (a >> (bits - 1) << bits)


def truncated(a, kind):
    lowest = -(1 << (BITS[kind] - 1))
    if not math.isfinite(a) or not lowest <= math.trunc(a) < -lowest:
        return lowest
    return math.trunc(a)


def reinterpreted(value, source, target):
    return struct.unpack(f"<{target}", struct.pack(f"<{source}", value))[0]


CONVERT = {
    "extend8_s": lambda a, _: extended(a, 8),
    "extend16_s": lambda a, _: extended(a, 16),
    "wrap_i64": lambda a, _: a,
    "extend_i32_s": lambda a, _: signed(a, "i32"),
    "extend_i32_u": lambda a, _: a,
    "convert_i32_s": lambda a, _: signed(a, "i32"),
    "convert_i32_u": lambda a, _: a,
    "convert_i64_s": lambda a, _: signed(a, "i64"),
    "convert_i64_u": lambda a, _: a,
    "promote_f32": lambda a, _: a,
    "demote_f64": lambda a, _: a,
    "reinterpret_f32": lambda a, _: reinterpreted(a, "f", "I"),
    "reinterpret_f64": lambda a, _: reinterpreted(a, "d", "Q"),
    "reinterpret_i32": lambda a, _: reinterpreted(a, "I", "f"),
    "reinterpret_i64": lambda a, _: reinterpreted(a, "Q", "d"),
    "trunc_f32_s": truncated,
    "trunc_f64_s": truncated,
}


def to_single_once(number):
    """An integer of 64 bits as REAL, rounded once."""
    if abs(number) < 1 << 53:
        return single(float(number))
    excess = abs(number).bit_length() - 26  # more than REAL has; what is cut off leaves a mark
    kept = abs(number) >> excess
    if abs(number) & ((1 << excess) - 1):
        kept |= 1
    return math.copysign(single(math.ldexp(float(kept), excess)), number)


LOAD = {
    "s8": "<b",
    "u8": "<B",
    "s16": "<h",
    "u16": "<H",
    "w32": "<I",
    "w64": "<Q",
    "f32": "<f",
    "f64": "<d",
}


class Interpreter:
    """Runs a module.

    Args:
        module: what to run.
        addresses: of its segments, by name.
        memory: its bytes from ``FIRST`` on; nothing else is valid.
        imports: by name; called with the interpreter and the arguments.
    """

    def __init__(self, module, addresses, memory, imports=None):
        self.functions = {function.name: function for function in module.functions}
        self.addresses = addresses
        self.memory = memory
        self.imports = imports or {}
        self.steps = 0

    def run(self, name, *arguments):
        function = self.functions[name]
        zeros = [0 if kind in BITS else 0.0 for kind in function.locals]
        try:
            self.statements(function.body, [*arguments, *zeros])
        except BackError as back:
            return back.value
        return None

    # memory

    def place(self, address, size):
        """Where bytes lie in ``memory``."""
        place = address - FIRST
        if not 0 <= place <= len(self.memory) - size:
            raise TrapError("page fault")
        return place

    def read(self, address, size):
        place = self.place(address, size)
        return bytes(self.memory[place : place + size])

    def write(self, address, data):
        place = self.place(address, len(data))
        self.memory[place : place + len(data)] = data

    def base(self, place, frame):
        if isinstance(place.base, ir.Segment):
            return self.addresses[place.base.name]
        return self.value(place.base, frame)

    def load(self, node, frame):
        address = self.base(node.place, frame) + node.place.offset
        data = self.read(address, ir.BYTES[node.width])
        value = struct.unpack(LOAD[node.width], data)[0]
        return wrap(value, node.type) if node.type in BITS else value

    def store(self, node, frame):
        address = self.base(node.place, frame) + node.place.offset
        value = self.value(node.value, frame)
        if node.width in ("f32", "f64"):
            self.write(address, struct.pack(LOAD[node.width], value))
        else:
            self.write(address, value.to_bytes(8, "little")[: ir.BYTES[node.width]])

    # expressions

    def value(self, node, frame):
        kind = type(node)
        if kind is ir.Const:
            return wrap(node.value, node.type) if node.type in BITS else self.real(node)
        if kind is ir.Local:
            return frame[node.index]
        if kind is ir.Load:
            return self.load(node, frame)
        if kind is ir.AddressOf:
            return wrap(self.base(node.place, frame) + node.place.offset, "i32")
        if kind is ir.Call:
            return self.call(node, frame)
        if kind is ir.IfExpression:
            chosen = node.then if self.value(node.condition, frame) else node.other
            return self.value(chosen, frame)
        if kind is ir.StatementExpression:
            self.statements(node.statements, frame)
            return self.value(node.value, frame)
        if kind is ir.Checked:
            index = self.value(node.index, frame)
            if index >= node.count:
                raise TrapError("index")
            return index
        return self.operation(node, frame)

    def real(self, node):
        return single(node.value) if node.type == "f32" else float(node.value)

    def operation(self, node, frame):
        kind = type(node)
        if kind is ir.Select:
            then, other = self.value(node.then, frame), self.value(node.other, frame)
            return then if self.value(node.condition, frame) else other
        if kind is ir.Unary:
            return self.unary(node.operator, node.type, self.value(node.operand, frame))
        if kind is ir.Convert:
            return self.convert(node, self.value(node.operand, frame))
        left, right = self.value(node.left, frame), self.value(node.right, frame)
        if kind is ir.Compare:
            return self.compare(node.operator, node.operands, left, right)
        if node.type in BITS:
            return wrap(integer_binary(node.operator, left, right, node.type), node.type)
        result = REAL_BINARY[node.operator](left, right)
        return single(result) if node.type == "f32" else result

    def unary(self, operator, kind, value):
        if kind in BITS:
            return integer_unary(operator, value, kind)
        result = REAL_UNARY[operator](value)
        return single(result) if kind == "f32" else result

    def convert(self, node, value):
        result = CONVERT[node.operator](value, node.type)
        if node.type in BITS:
            return wrap(result, node.type)
        if node.type == "f64":
            return float(result)
        return to_single_once(result) if isinstance(result, int) else single(result)

    def compare(self, operator, kind, left, right):
        if operator.endswith("_s"):
            left, right = signed(left, kind), signed(right, kind)
        return int(COMPARE[operator.partition("_")[0]](left, right))

    def call(self, node, frame):
        arguments = [self.value(argument, frame) for argument in node.arguments]
        if node.function in self.imports:
            return self.imports[node.function](self, *arguments)
        if node.function in HELPERS:
            return HELPERS[node.function](self, *arguments)
        return self.run(node.function, *arguments)

    # statements

    def statements(self, sequence, frame):
        for node in sequence:
            self.steps += 1
            if self.steps > 200_000:
                raise AssertionError("the program of the test does not end")
            self.statement(node, frame)

    def statement(self, node, frame):
        kind = type(node)
        if kind is ir.Store:
            self.store(node, frame)
        elif kind is ir.SetLocal:
            frame[node.index] = self.value(node.value, frame)
        elif kind is ir.Evaluate:
            self.value(node.value, frame)
        elif kind is ir.Break:
            raise LeaveError(node.label)
        elif kind is ir.Continue:
            raise AgainError(node.label)
        elif kind is ir.Return:
            raise BackError(None if node.value is None else self.value(node.value, frame))
        elif kind is ir.CopyBytes:
            target, source, count = (
                self.value(one, frame) for one in (node.target, node.source, node.count)
            )
            copy(self, target, source, count)
        elif kind is ir.FillBytes:
            target, value, count = (
                self.value(one, frame) for one in (node.target, node.value, node.count)
            )
            fill(self, target, value, count)
        else:
            self.structure(node, frame)

    def structure(self, node, frame):
        kind = type(node)
        if kind is ir.If:
            for arm in node.arms:
                if self.value(arm.condition, frame):
                    self.statements(arm.body, frame)
                    return
            self.statements(node.other, frame)
        elif kind is ir.Switch:
            value = signed(self.value(node.selector, frame), "i32")
            fitting = [c for c in node.cases if any(lo <= value <= hi for lo, hi in c.ranges)]
            self.statements(fitting[0].body if fitting else node.other, frame)
        elif kind is ir.Block:
            try:
                self.statements(node.body, frame)
            except LeaveError as leave:
                if leave.label != node.label:
                    raise
        else:
            self.loop(node, frame)

    def loop(self, node, frame):
        while True:
            try:
                self.statements(node.body, frame)
            except LeaveError as leave:
                if leave.label != node.label:
                    raise
                return
            except AgainError as again:
                if again.label != node.label:
                    raise


def copy(self, target, source, count):
    if count:
        self.write(target, self.read(source, count))


def fill(self, target, value, count):
    if count:
        self.write(target, bytes([value & 0xFF]) * count)


def assign(self, target, source, limit, size=1):
    for _ in range(max(0, signed(limit, "i32"))):
        character = self.read(source, size)
        if not any(character):
            break
        self.write(target, character)
        target, source = target + size, source + size
    self.write(target, bytes(size))


def compare_strings(self, left, right, size=1):
    while True:
        one = int.from_bytes(self.read(left, size), "little")
        other = int.from_bytes(self.read(right, size), "little")
        if one != other or not one:
            return wrap(one - other, "i32")
        left, right = left + size, right + size


HELPERS = {
    "rt.string_assign": assign,
    "rt.wstring_assign": lambda self, *given: assign(self, *given, size=2),
    "rt.string_compare": compare_strings,
    "rt.wstring_compare": lambda self, *given: compare_strings(self, *given, size=2),
}
