"""Short ways to write trees of the intermediate representation in tests."""

from plcsim.program.structured_text import ir

PROGRAM = ir.Segment("program", 4096)
FILES = ("Main.st",)
TYPES = {"f32": "f32", "f64": "f64", "w64": "i64"}


def number(value):
    return ir.Const("i32", value)


def place(offset, root=None):
    """A variable of the program; a root of its own unless one is given."""
    return ir.Place(PROGRAM, offset, offset + 1 if root is None else root)


def load(offset, width="w32", root=None):
    return ir.Load(ir.VALUE_TYPE[width], width, place(offset, root))


def store(offset, value, width="w32", root=None, line=1):
    value = number(value) if isinstance(value, int) else value
    return ir.Store(line, width, place(offset, root), value)


def address(offset, root=None):
    return ir.AddressOf(place(offset, root))


def op(operator, left, right):
    right = number(right) if isinstance(right, int) else right
    return ir.Binary(left.type, operator, left, right)


def is_(left, operator, right):
    right = number(right) if isinstance(right, int) else right
    return ir.Compare(left.type, operator, left, right)


def if_(condition, then, other=(), line=1):
    return ir.If(line, [ir.Arm(line, condition, then)], other)


def for_(offset, last, body, label=1, line=1, width="w32"):
    """FOR v := 0 TO last, as it is lowered."""
    over = is_(load(offset, width), "gt_s", last)
    step = store(offset, op("add", load(offset, width), 1), width, line=line)
    loop = ir.Loop(line, label, [if_(over, [ir.Break(line, label)], line=line), *body, step])
    return [store(offset, 0, width, line=line), loop]


def call(name, *arguments, result=None):
    return ir.Call(result, name, arguments)


def evaluate(expression, line=1):
    return ir.Evaluate(line, expression)


def unit(*body, name="CYCLIC", locals_=(), line=1):
    return ir.Function(name, "unit", (), None, locals_, body, line=line, exported=True)


def function(name, parameters, result, *body, kind="function", locals_=(), exported=True):
    return ir.Function(name, kind, parameters, result, locals_, body, exported=exported)


def module(*functions, imports=None, segments=(PROGRAM,)):
    return ir.Module("test", functions, imports or {}, segments, FILES)


def program(*body, **more):
    """A module with nothing but CYCLIC."""
    return module(unit(*body, **more))
