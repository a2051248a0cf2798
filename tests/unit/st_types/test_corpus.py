"""The corpus below tests/corpus/st_types.

No false error over ``good`` and ``odd``; over ``bad`` the findings that are written beside it.
"""

import re
import runpy
from collections.abc import Iterable
from pathlib import Path

import pytest

from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations, parse_text
from st_types.syntax.diagnostics import render_all
from st_types.syntax.printer import print_file
from st_types.syntax.source import Source
from st_types.syntax.tree import DeclarationFile
from st_types.types.values import decode, encode, initial_image

CORPUS = Path(__file__).parents[2] / "corpus" / "st_types"
LIBRARY = Path(__file__).parents[3] / "plcsim" / "library"
SUFFIXES = (".typ", ".var", ".fun")

ROWS = {
    "struct": r"STRUCT\b.*END_STRUCT",
    "enumeration_plain": r"\( .*\sMODE_OFF,",
    "enumeration_valued": r"STEP_WAIT := 10",
    "enumeration_negative": r":= -1,",
    "enumeration_hexadecimal": r":= 16#10",
    "several_type_blocks": r"TYPE.*END_TYPE.*TYPE.*END_TYPE",
    "empty_type_block": r"TYPE\s*END_TYPE",
    "empty_struct": r"STRUCT [^;]*\n\s*END_STRUCT",
    "empty_var_block": r"VAR\s*END_VAR",
    "empty_file": r"\A\Z",
    "blank_file": r"\A\s+\Z",
    "alias": r": STRING\[32\];.*: ARRAY\[0..9\] OF INT;",
    "subrange": r"USINT\(1..6\).*SINT\(-3..6\)",
    "array_of_numbers": r"ARRAY\[0..255\]",
    "array_from_one_or_below_zero": r"ARRAY\[1.*ARRAY\[-5",
    "array_up_to_a_constant": r"\[0..MAX_AXES\]",
    "array_from_a_constant": r"\[FIRST_ZONE..LAST_ZONE\]",
    "array_bound_expression": r"\[0..COUNT - 1\]",
    "array_of_two_dimensions": r"\[0..3,0..4\]",
    "of_without_blank": r"\]OF ",
    "string_length": r"STRING\[80\]",
    "string_constant_length": r"STRING\[NAME_LENGTH\]",
    "wstring": r"WSTRING\[",
    "reference": r"REFERENCE TO REAL.*REFERENCE TO ARRAY.*REFERENCE TO TON",
    "member_initial": r"REAL := 12.5",
    "struct_initial": r"\(X:=1.0,Y:=2.0\).*\(Start:=\(X",
    "struct_initial_zero": r":= \(0\)",
    "function_block_initial": r"TON := \(PT:=T#1s\)",
    "array_initial": r":= \[2,3,5",
    "array_initial_repeated": r"\[13\(0\)\]",
    "array_of_struct_initial": r"\[\(Length:=1.0",
    "string_initial_escapes": r"\$r\$n.*\$'",
    "wstring_initial": r':= "Overview"',
    "time_initial": r"T#10ms",
    "date_initial": r"DT#.*TOD#.*D#",
    "number_initial": r"16#FFFF.*1.5E-3.*BYTE#16#0F",
    "constant_initial": r":= LIMIT;",
    "constant_expression": r"MAX_IDX - 1",
    "var_constant": r"VAR CONSTANT",
    "var_retain": r"VAR RETAIN",
    "var_in_out": r"VAR_IN_OUT",
    "function": r"FUNCTION ScaleValue : REAL.*: STRING\[80\]",
    "function_of_a_struct": r"FUNCTION Evaluate : ResultType",
    "function_block": r"FUNCTION_BLOCK.*VAR_INPUT.*VAR_OUTPUT.*VAR\s",
    "function_block_constant_and_retain": r"FUNCTION_BLOCK.*VAR CONSTANT.*VAR RETAIN",
    "input_initial": r"VAR_INPUT.*:= 1.0",
    "outputs_before_inputs": r"VAR_OUTPUT.*VAR_INPUT",
    "any": r"ANY_NUM.*ANY_INT.*ANY_REAL.*ANY;",
    "pragmas": r"\{REDUND_UNREPLICABLE\} FUNCTION_BLOCK",
    "pragmas_of_members": r": \{REDUND_UNREPLICABLE\} BOOL",
    "comments": r"\(\*\$GROUP.*\(\*\[\*\).*//.*/\*",
    "comments_between_keywords": r"FUNCTION_BLOCK \(\*",
    "long_integers": r"LINT.*ULINT",
    "elementary_types": r"BOOL.*LREAL.*DATE_AND_TIME",
    "keywords_as_names": r"\tStruct : INT",
    "forward_references": r"LATE_HALF \* 2",
    "semicolons": r";;;",
    "direct_addresses": r"AT %IX0.1",
    "lists_of_names": r"a, b, c : INT",
}
"""Rows of the table of features in real projects, each with what its file must hold."""


def files_below(name: str) -> list[Path]:
    return [path for path in sorted((CORPUS / name).rglob("*")) if path.suffix in SUFFIXES]


def read(path: Path) -> DeclarationFile:
    return parse_declarations(Source.read(path, str(path.relative_to(CORPUS))))


def library() -> Scope:
    paths = [path for path in sorted(LIBRARY.rglob("*")) if path.suffix in SUFFIXES]
    return Scope("library", [parse_declarations(Source.read(path)) for path in paths])


def scopes_of(files: Iterable[DeclarationFile]) -> list[Scope]:
    """Return a scope for each folder; it sees the folders around it."""
    folders: dict[Path, list[DeclarationFile]] = {}
    for file in files:
        folders.setdefault(Path(file.path).parent, []).append(file)
    scopes: dict[Path, Scope] = {}
    known = [library()]
    for folder, inside in sorted(folders.items()):
        around = [scopes[parent] for parent in folder.parents if parent in scopes]
        scopes[folder] = Scope(folder.name, inside, [*around, *known], strict=True)
        scopes[folder].check()
    return list(scopes.values())


@pytest.fixture(scope="module")
def sound() -> list[Scope]:
    return scopes_of(read(path) for path in [*files_below("good"), *files_below("odd")])


def test_there_are_enough_files_and_each_feature_has_some() -> None:
    assert len(files_below("good")) + len(files_below("odd")) >= 200
    assert {path.name for path in (CORPUS / "good").iterdir()} == set(ROWS)


@pytest.mark.parametrize("feature", ROWS)
def test_a_file_shows_its_feature(feature: str) -> None:
    (path,) = (CORPUS / "good" / feature / "automation_studio").iterdir()
    text = path.read_bytes().decode("ascii")
    assert re.search(ROWS[feature], text, re.DOTALL)
    assert "\n" not in text.replace("\r\n", "")


def test_the_other_styles_are_up_to_date() -> None:
    made = runpy.run_path(str(CORPUS / "generate.py"))["files"]()
    assert len(made) == 2 * len(ROWS)
    assert {path: path.read_bytes() for path in made} == made


def test_no_false_error(sound: list[Scope]) -> None:
    files = [file for scope in sound for file in scope.files]
    found = [record for file in files for record in file.diagnostics.records]
    assert render_all(found) == ""


def test_every_variable_starts_with_a_value_that_reads_back(sound: list[Scope]) -> None:
    for data_type in [each for scope in sound for each in scope.data_types()]:
        image = initial_image(data_type)
        assert encode(data_type, decode(data_type, image)) == image
    variables = [variable for scope in sound for variable in scope.variables]
    assert len(variables) > 200
    for variable in variables:
        assert variable.data_type is not None
        assert len(encode(variable.data_type, variable.initial)) == variable.data_type.size


@pytest.mark.parametrize("feature", ROWS)
def test_the_styles_mean_the_same(feature: str) -> None:
    meanings = []
    for style in ("automation_studio", "by_hand", "dense"):
        (path,) = (CORPUS / "good" / feature / style).iterdir()
        (scope,) = scopes_of([read(path)])
        meanings.append(
            {
                "types": [(t.name, t.size, initial_image(t)) for t in scope.data_types()],
                "variables": [(v.name, str(v.data_type), v.initial) for v in scope.variables],
                "functions": [function.name for function in scope.functions],
            }
        )
    assert meanings[0] == meanings[1] == meanings[2]


def test_printing_and_parsing_again_gives_the_same_trees(sound: list[Scope]) -> None:
    for file in [file for scope in sound for file in scope.files]:
        printed = print_file(file)
        again = parse_text(printed, file.path)
        assert again == file
        assert print_file(again) == printed


@pytest.mark.parametrize("path", files_below("bad"), ids=lambda path: path.name)
def test_findings(path: Path) -> None:
    file = read(path)
    Scope("bad", [file], [library()]).check()
    records = sorted(file.diagnostics.records, key=lambda r: (r.line, r.column))
    assert records, "a file without a finding belongs to the good ones"
    expected = path.with_name(path.name + ".expected").read_text()
    assert render_all(records).replace("bad/", "") + "\n" == expected
