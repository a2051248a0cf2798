import pytest

from plcsim.program.structured_text.syntax.tree import (
    ActionUnit,
    Configuration,
    FunctionBlockUnit,
    FunctionUnit,
    Include,
    InterfaceUnit,
    MethodUnit,
    NamespaceUnit,
    Part,
    ProgramUnit,
    StepUnit,
    TransitionUnit,
    Unit,
)
from st_types.syntax.expression_printer import print_expression as text_of
from st_types.syntax.tree import TypeBlock, VariableBlock

from ..cases import cases
from .shapes import findings, parse, shapes


def block_names(blocks: object) -> str:
    assert isinstance(blocks, list)
    return " ".join(
        f"{block.section}({','.join(item.name for item in block.declarations)})" for block in blocks
    )


def outline(unit: Unit | Part) -> str:
    match unit:
        case ProgramUnit():
            text = f"program {unit.name}: {block_names(unit.blocks)} {{{shapes(unit.body)}}}"
            return " ".join([text, *map(outline, unit.parts)])
        case FunctionUnit() | FunctionBlockUnit() | MethodUnit():
            kind = type(unit).__name__.removesuffix("Unit")
            blocks = block_names(unit.declaration.blocks)
            words = " ".join(unit.words) if not isinstance(unit, FunctionUnit) else ""
            bases = ",".join(unit.bases) if isinstance(unit, FunctionBlockUnit) else ""
            text = (
                f"{words} {kind} {unit.declaration.name} {bases}: {blocks} {{{shapes(unit.body)}}}"
            )
            parts = unit.parts if isinstance(unit, FunctionBlockUnit) else []
            return " ".join([" ".join(text.split()), *map(outline, parts)])
        case ActionUnit():
            return f"action {unit.name} {{{shapes(unit.body)}}}"
        case InterfaceUnit():
            bases = ",".join(unit.bases)
            return " ".join([f"interface {unit.name} {bases}:", *map(outline, unit.parts)])
        case NamespaceUnit():
            return f"namespace {unit.name}"
        case StepUnit():
            actions = "".join(f" {each.action}({each.qualifier})" for each in unit.associations)
            bodies = f"{{{shapes(unit.body)}}}"
            return f"{'initial ' * unit.is_initial}step {unit.name}{actions} {bodies}"
        case TransitionUnit():
            sources = ",".join(each.name for each in unit.sources)
            targets = ",".join(each.name for each in unit.targets)
            return f"transition {sources} to {targets} {text_of(unit.condition)}"
        case VariableBlock():
            return block_names([unit])
        case TypeBlock():
            return f"types {','.join(item.name for item in unit.declarations)}"
        case Include():
            return f"include {unit.path}"
    raise AssertionError(unit)


def outlines(text: str) -> list[str]:
    file = parse(text)
    file.diagnostics.raise_errors()
    return [outline(unit) for unit in file.units]


@pytest.mark.parametrize(("text", "expected"), cases("units.txt"))
def test_units(text: str, expected: str) -> None:
    assert "\n".join(outlines(text)) == expected


@pytest.mark.parametrize(("text", "expected"), cases("vendor_units.txt"))
def test_what_other_vendors_write(text: str, expected: str) -> None:
    assert "\n".join(outlines(text)) == expected


def test_a_configuration_holds_tasks_and_programs() -> None:
    file = parse(
        "CONFIGURATION c VAR_GLOBAL g : INT; END_VAR RESOURCE r ON PLC"
        " TASK t(INTERVAL := T#20ms, PRIORITY := 1); PROGRAM RETAIN p1 WITH t : main(x := 1);"
        " PROGRAM p2 : main; END_RESOURCE END_CONFIGURATION"
    )
    file.diagnostics.raise_errors()
    (found,) = file.units
    assert isinstance(found, Configuration)
    assert block_names(found.blocks) == "VAR_GLOBAL(g)"
    (resource,) = found.resources
    assert (found.name, resource.name, resource.processor) == ("c", "r", "PLC")
    assert [(task.name, [a.name for a in task.arguments]) for task in resource.tasks] == [
        ("t", ["INTERVAL", "PRIORITY"])
    ]
    assert [(p.name, p.task, p.type_name) for p in resource.programs] == [
        ("p1", "t", "main"),
        ("p2", "", "main"),
    ]


@pytest.mark.parametrize(("text", "expected"), cases("unit_errors.txt"))
def test_errors(text: str, expected: str) -> None:
    assert "\n".join(findings(text)) == expected


@pytest.mark.parametrize(
    "text",
    [
        "PROGRAM p ",
        "ACTION a: ",
        "FUNCTION_BLOCK ",
        "CONFIGURATION c RESOURCE r ON p ",
        "RESOURCE r ",
        "NAMESPACE n ",
        "INTERFACE i METHOD m ",
        "VAR a : ARRAY[0..1] OF ",
        "TYPE a : STRUCT ",
        "PROPERTY p GET ",
    ],
)
def test_deep_nesting_is_an_error_and_takes_linear_time(text: str) -> None:
    assert 1 <= len(findings(text * 10_000)) <= 20
