"""Variables that C defines as _GLOBAL are one for all programs of a controller."""

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError

PLC = """
[task_class.1]
cycle = "10ms"
programs = ["first", "second", {name = "third", source = "second"}]
"""
HEAD = "#include <AsDefault.h>\n"
FIRST = HEAD + (
    "_GLOBAL UDINT count;\n_GLOBAL REAL list[3] = {1, 2, 3};\nstatic UDINT own;\nUDINT plain;\n"
    "void _CYCLIC run(void) { count++; own++; plain++; list[1] += 0.5; }\n"
)
SECOND = HEAD + (
    "_GLOBAL UDINT count;\n_GLOBAL REAL list[3];\nstatic UDINT own;\nUDINT plain;\nREAL seen;\n"
    "void _CYCLIC run(void) { count += 10; own++; seen = list[1]; }\n"
)


@pytest.fixture(autouse=True)
def _a_compiler():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


@pytest.fixture
def files():
    return {"plc.toml": PLC, "first/Main.c": FIRST, "second/Main.c": SECOND}


def test_it_is_one_for_all_programs_and_a_tag_of_the_first(run, value, files):
    controller = run(files, cycles=3)
    assert value(controller, "first.count") == 3 * 21
    assert value(controller, "second.seen") == value(controller, "third.seen") == 3.5
    assert value(controller, "first.own") == value(controller, "third.own") == 3
    assert value(controller, "second.plain") == 0
    assert controller.tags.get("second.count") is None
    controller.shutdown()
    controller.boot()
    assert value(controller, "first.count") == 0
    assert value(controller, "first.list[1]") == 2.0


def test_what_a_var_file_declares_is_that(run, value, files):
    files["Global.var"] = "VAR count : UDINT := 100; END_VAR"
    controller = run(files, cycles=1)
    assert value(controller, "count") == 121
    assert controller.tags.get("first.count") is None


def test_two_sizes_are_refused(run, files):
    files["second/Main.c"] = SECOND.replace("list[3]", "list[4]")
    with pytest.raises(ConfigurationError) as refused:
        run(files)
    assert refused.value.findings[0] == ("second: _GLOBAL list has 16 bytes here, and 12 in first")
