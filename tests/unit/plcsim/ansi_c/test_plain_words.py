import pytest

from plcsim.ansi_c.plain_words import defined_twice, explained, first_use, place_of, plain_name


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "deep" / "include").mkdir(parents=True)
    (tmp_path / "deep" / "include" / "Inner.h").touch()
    (tmp_path / "string.h").touch()
    return tmp_path


@pytest.mark.parametrize(
    ("header", "hint"),
    [
        ("Inner.h", "deep/include/Inner.h: name its folder in [c] include of plc.toml"),
        ("strng.h", "did you mean string.h?"),
        ("sys/un.h", "TCP is the library AsTCP (AsTCP.h)"),
        ("threads.h", "a controller has no threads"),
        ("sys/mman.h", "a controller has one process"),
    ],
)
def test_a_header_that_is_not_there_is_told_with_what_may_help(folder, header, hint):
    told = explained(f"main.c:1:10: '{header}' file not found", [folder])
    assert told.startswith(f"main.c:1:10: '{header}' file not found; ")
    assert hint in told


def test_other_findings_stay_as_they_are(folder):
    assert explained("main.c:2:1: unknown type name 'x'", [folder]).endswith("'x'")


@pytest.mark.parametrize("text", ["{ int inner(int x) { return x; }", "{\n\tint inner(int x)\n\t{"])
def test_a_nested_function_is_named(tmp_path, text):
    file = tmp_path / "a.c"
    file.write_text(f"void outer(void)\n{text} }}\n")
    line = text.count("\n") + 2
    column = text.splitlines()[-1].rindex("{") + 1
    place = f"{file}:{line}:{column}: function definition is not allowed here"
    assert explained(place, []).startswith(f"{place}: inner is a nested function, an extension of")
    missing = "gone.c:1:2: function definition is not allowed here"
    assert explained(missing, []).startswith(f"{missing}: is a nested function")


def test_two_definitions_are_told_with_both_places(tmp_path):
    one, other = tmp_path / "a.c", tmp_path / "b.c"
    one.write_text("extern int f(int);\n\nint f(int x) { return x; }\n")
    other.write_text("static int g;\nint\tf(int x)\n{\n\treturn 1;\n}\n")
    told = defined_twice(f"duplicate symbol: f, defined in {one}, defined in {other}")
    assert f"{one}:3 and at {other}:2" in told
    assert defined_twice("something else") == "something else"


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("int x;\n_GLOBAL UDINT speed = 1;\n", ":2"),
        ("\n\nDINT speed[3] = {1};", ":3"),
        ("void Machine::speed(int x) {}", ":1"),
        ("// speed\n#define speed 1\nextern int speed;\n\treturn speed;", ""),
    ],
)
def test_the_line_of_a_definition(tmp_path, text, line):
    file = tmp_path / "a.c"
    file.write_text(text)
    assert place_of("Machine::speed(int)" if "::" in text else "speed", file) == f"{file}{line}"


def test_a_use_is_found_behind_comments_and_declarations(tmp_path):
    file = tmp_path / "Main.c"
    file.write_text(
        "// go();\nvoid go(int);\n/* x = go(1);\n*/ int y;\nint f() { return go(2); }\n"
    )
    missing = tmp_path / "gone.c"
    assert first_use("go", [missing, file]) == f"{file}:5"
    assert first_use("y", [file]) == f"{file}:4"
    assert first_use("Class::go", [file]) == f"{file}:5"
    assert first_use("else", [file]) == ""


@pytest.mark.parametrize(
    ("symbol", "name"),
    [("strupr", "strupr"), ("_Z4stepv", "step"), ("_ZN5Motor5startEi", "Motor::start")],
)
def test_names_of_cpp_are_told_as_they_are_written(symbol, name):
    assert plain_name(symbol) == name
