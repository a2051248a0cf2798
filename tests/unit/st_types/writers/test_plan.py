from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text
from st_types.writers.plan import PlannedFile, left_out, plan_files

from ..checked import checked


def planned(*files: PlannedFile) -> list[tuple[str, list[str]]]:
    return [(file.name, [each.name for each in file.includes]) for file in plan_files(files)]


def scope_of(name: str, text: str, outer: list[Scope]) -> Scope:
    return Scope(name, [parse_text(text)], outer)


def test_a_file_includes_what_its_types_need_and_what_it_sees() -> None:
    a = scope_of("a", "TYPE A : STRUCT x : INT; END_STRUCT; END_TYPE", [])
    b = scope_of("b", "TYPE B : REFERENCE TO ARRAY[0..1] OF A; END_TYPE", [a])
    c = scope_of("c", "FUNCTION F : INT VAR_INPUT x : B; END_VAR END_FUNCTION", [b])
    d = scope_of("d", "VAR x : A; END_VAR", [c])
    e = scope_of("e", "TYPE E : INT; END_TYPE", [d])
    files = [PlannedFile(s.name, s, sees=[d] if s is e else ()) for s in (e, d, c, b, a)]
    assert planned(*files) == [
        ("a", []),
        ("d", ["a"]),
        ("e", ["d"]),
        ("b", ["a"]),
        ("c", ["b"]),
    ]
    assert {each.name for each in files[2].closure()} == {"a", "b"}


def test_of_files_that_need_one_another_one_goes_without() -> None:
    both: list[Scope] = []
    both.append(scope_of("a", "TYPE A1 : INT; A2 : B1; END_TYPE", both))
    both.append(scope_of("b", "TYPE B1 : BOOL; B2 : A1; END_TYPE", both))
    assert planned(*(PlannedFile(s.name, s) for s in both)) == [("b", []), ("a", ["b"])]


def test_a_long_chain_of_files() -> None:
    scopes: list[Scope] = []
    for number in range(300):
        target = f"REFERENCE TO T{number - 1}" if number else "INT"
        scopes.append(scope_of(str(number), f"TYPE T{number} : {target}; END_TYPE", scopes[-1:]))
    found = planned(*(PlannedFile(s.name, s) for s in reversed(scopes)))
    assert [name for name, _ in found] == [str(number) for number in range(300)]


def test_what_has_no_layout_is_named_unless_it_is_meant_for_any_type() -> None:
    scope = checked(
        [
            parse_text(
                "TYPE A : Lib; B : INT; END_TYPE VAR v : ARRAY[0..N] OF INT; w : INT; END_VAR "
                "FUNCTION F : Lib END_FUNCTION FUNCTION G : ANY VAR_INPUT x : ANY_NUM; END_VAR "
                "VAR y : Lib; END_VAR END_FUNCTION FUNCTION_BLOCK C VAR x : ANY; END_VAR "
                "END_FUNCTION_BLOCK"
            )
        ]
    )
    assert left_out(scope) == ["type A", "function block C", "variable v", "function F"]
