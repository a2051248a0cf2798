"""Lowering of a whole program, or of a library: its bodies become functions of one module."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.lower.context import (
    FunctionContext,
    LoweringContext,
    value_type_of,
)
from plcsim.program.structured_text.lower.memory import constant_of, is_scalar, width_of
from plcsim.program.structured_text.lower.semantics import AUTOMATION_STUDIO
from plcsim.program.structured_text.lower.statements import StatementLowering
from st_types.syntax.collector import collector_paused
from st_types.types.derived import StringType, WStringType

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.program.structured_text.check.typed import CheckedBody, CheckedProgram, Symbol
    from plcsim.program.structured_text.lower.memory import Areas
    from plcsim.program.structured_text.lower.semantics import Semantics


@collector_paused()
def lower(
    program: CheckedProgram, areas: Areas, semantics: Semantics = AUTOMATION_STUDIO
) -> ir.Module:
    """Return the intermediate representation of a program.

    Functions are named ``init``, ``cyclic``, ``exit`` (exported), ``action NAME``,
    ``action BLOCK.NAME``, ``block NAME`` and ``function NAME`` (exported); the segment ``hidden``
    holds what the program declares nowhere.

    Args:
        program: checked without errors.
        areas: where the variables of its scope and of those around it lie.
        semantics: of its dialect.
    """
    module = LoweringContext(areas, semantics)
    module.own = {function_name(body) for body in program.bodies}
    files = list(dict.fromkeys(body.path for body in program.bodies))
    functions = [_function(module, body, files.index(body.path)) for body in program.bodies]
    segments = list({spot.segment: None for area in areas.values() for spot in area.values()})
    segments.append(module.hidden.finish())
    if module.variables.direct is not None:
        segments.append(module.variables.direct)
    return ir.Module(program.name, functions, module.imports, segments, files)


def function_name(body: CheckedBody) -> str:
    """Return the name of the function that a body becomes."""
    if body.kind == "unit":
        return body.name
    if body.kind == "action" and body.block is not None:
        return f"action {body.block.name}.{body.name}"
    return f"{body.kind} {body.name}"


def _function(module: LoweringContext, body: CheckedBody, file: int) -> ir.Function:
    parameters, result = _signature(body)
    has_frame = body.is_recursive and body.kind in _FUNCTIONS
    context = FunctionContext(module, body.block, parameters, is_recursive=has_frame)
    _place_parameters(context, body)
    start = _initial_statements(context, body)
    lowering = StatementLowering(context, lambda: _returned(lowering, body))
    statements = [*start, *lowering.statements(body.statements)]
    value = _returned(lowering, body)
    if value is not None:
        statements.append(ir.Return(body.line, value))
    return ir.Function(
        function_name(body),
        body.kind,
        parameters,
        result,
        context.locals[len(parameters) :],
        statements,
        file,
        body.line,
        exported=body.kind not in ("action", "method"),
        frame=ir.NO_FRAME if context.frame is None else context.frame.finish(),
    )


_FUNCTIONS = ("function", "method")


def _signature(body: CheckedBody) -> tuple[list[ir.ValueType], ir.ValueType | None]:
    """Return parameters and result; a result that is no scalar goes to the first parameter."""
    this: list[ir.ValueType] = ["i32"] if body.block is not None else []
    if body.kind not in _FUNCTIONS:
        return this, None
    parameters: list[ir.ValueType] = [
        "i32" if symbol.by_address else value_type_of(symbol.type) for symbol in body.parameters
    ]
    if body.result is None:
        return [*this, *parameters], None
    if is_scalar(body.result.type):
        return [*this, *parameters], value_type_of(body.result.type)
    return [*this, "i32", *parameters], None


def _place_parameters(context: FunctionContext, body: CheckedBody) -> None:
    """Parameters stay in their locals, unless the address of one is taken."""
    first = 1 if body.kind == "method" else 0
    if body.result is not None and not is_scalar(body.result.type):
        body.result.by_address = True
        context.in_locals[body.result] = first
        first += 1
    for index, symbol in enumerate(body.parameters, first):
        if symbol.by_address or not symbol.has_address:
            context.in_locals[symbol] = index
        else:
            context.add_to_frame(symbol)
    for symbol in body.locals:
        context.add_variable(symbol)
    if body.result is not None and is_scalar(body.result.type):
        context.add_variable(body.result)


def _initial_statements(context: FunctionContext, body: CheckedBody) -> list[ir.Statement]:
    """Give variables that live for one call their initial values."""
    found: list[ir.Statement] = []
    first = 1 if body.result is not None and body.result.by_address else 0
    first += body.kind == "method"
    for index, symbol in enumerate(body.parameters, first):
        if symbol not in context.in_locals:
            value_type = context.locals[index]
            place = context.place(symbol)
            value = ir.Local(value_type, index)
            found.append(ir.Store(body.line, width_of(symbol.type), place, value))
        elif symbol.is_input and symbol.written and context.module.semantics.copies_inputs:
            found += _copied(context, symbol, index, body.line)
    symbols = [*body.locals, *([body.result] if body.result is not None else [])]
    for symbol in symbols:
        found += _initialised(context, symbol, body.line)
    return found


def _copied(
    context: FunctionContext, symbol: Symbol, index: int, line: int
) -> Sequence[ir.Statement]:
    """Let a parameter that is written lead to a copy of what the caller gave."""
    if not symbol.by_address:
        return ()
    data_type = symbol.type
    own = ir.AddressOf(context.temporary(data_type))
    given = ir.Local("i32", index)
    copy: ir.Statement = ir.CopyBytes(line, own, given, ir.Const("i32", data_type.size))
    if isinstance(data_type, StringType | WStringType):
        helper = "rt.string_assign" if isinstance(data_type, StringType) else "rt.wstring_assign"
        arguments = (own, given, ir.Const("i32", data_type.length))
        copy = ir.Evaluate(line, ir.Call(None, helper, arguments))
    return [copy, ir.SetLocal(line, index, own)]


def _initialised(context: FunctionContext, symbol: Symbol, line: int) -> Sequence[ir.Statement]:
    variables = context.module.variables
    image = variables.image(symbol)
    index = context.in_locals.get(symbol)
    if index is not None and not symbol.by_address:
        if not any(image):
            return ()
        value = constant_of(image, width_of(symbol.type))
        return [ir.SetLocal(line, index, value)]
    place = context.place(symbol) if index is None else None
    target = ir.Local("i32", index or 0) if place is None else ir.AddressOf(place)
    size = ir.Const("i32", len(image))
    if not any(image):
        return [ir.FillBytes(line, target, ir.Const("i32", 0), size)]
    hidden = context.module.hidden
    source = ir.Place(hidden.segment, hidden.literal(image, symbol.type.alignment))
    return [ir.CopyBytes(line, target, ir.AddressOf(source), size)]


def _returned(lowering: StatementLowering, body: CheckedBody) -> ir.Expression | None:
    """Return the value of the function's result, None where it has none or lies in memory."""
    result = body.result
    if result is None or result.by_address:
        return None
    index = lowering.function.in_locals.get(result)
    width = width_of(result.type)
    value_type = ir.VALUE_TYPE[width]
    if index is not None:
        return ir.Local(value_type, index)
    return ir.Load(value_type, width, lowering.function.place(result))
