"""fopen and its relations, from programs in C, on a device of the library FileIO."""

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.clock import VirtualClock
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project

PLC = '[task_class.1]\ncycle = "1ms"\nprograms = ["main"]\n'
DEVICES = '[library.FileIO]\ndevices = {"F:" = "disk", "G:" = "other"}\n'
HEAD = """
#include <bur/plctypes.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
DINT result;
DINT error;
char text[200];
"""


TAIL = "void _CYCLIC g(void) { static int cycles; if (cycles++) *(volatile int *)0 = 1; }\n"
NAMES = ("result", "error", "text")


@pytest.fixture
def run(tmp_path):
    """``run("result = 1;")``: what the body of INIT leaves in result, error and text."""
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")
    (tmp_path / "main").mkdir()
    (tmp_path / "disk").mkdir()
    (tmp_path / "other").mkdir()

    def run(body, settings=DEVICES):
        (tmp_path / "plc.toml").write_text(PLC + settings)
        source = f"{HEAD}\nvoid _INIT f(void)\n{{\n{body}\n}}\n{TAIL}"
        (tmp_path / "main" / "main.c").write_text(source)
        plc = assemble(load(read_project(tmp_path)), clock=VirtualClock(), network=None)
        run.controller = plc
        plc.boot()
        plc.run(cycles=1)
        assert plc.state is State.RUN, plc.fault
        values = [plc.tags.read(plc.tags.find(f"main.{name}")) for name in NAMES]
        return tuple(values)

    return run


def test_what_was_written_is_read(run, tmp_path):
    result, _, text = run(
        'FILE *f = fopen("F:/a.txt", "w");'
        'result = fprintf(f, "%d %s\\n%5.2f", 42, "cycles", 1.5);'
        'fclose(f); f = fopen("F:/a.txt", "r");'
        "fgets(text, sizeof text, f); fgets(text + 100, 100, f);"
        "strcat(text, text + 100); error = fgetc(f) == EOF && feof(f); fclose(f);"
    )
    assert result == 15
    assert text == "42 cycles\n 1.50"
    assert (tmp_path / "disk" / "a.txt").read_text() == "42 cycles\n 1.50"


def test_a_file_is_read_from_any_place_and_written_in_the_middle(run, tmp_path):
    (tmp_path / "disk" / "a.bin").write_bytes(bytes(range(256)) * 10)
    result, error, _ = run(
        'FILE *f = fopen("f:/a.bin", "r+");'
        "fseek(f, -2, SEEK_END); result = fgetc(f) * 1000000 + ftell(f);"
        "fseek(f, 1500, SEEK_SET); ungetc('x', f); error = fgetc(f) == 'x' && fgetc(f) == 220;"
        'fseek(f, 600, SEEK_SET); error = error * 10 + fwrite("abc", 1, 3, f);'
        "error = error * 1000 + fgetc(f); fclose(f);"
    )
    assert result == 254_002_559
    assert error == 13_000 + 603 % 256
    assert (tmp_path / "disk" / "a.bin").read_bytes()[598:605] == b"VWabc[\\"


def test_appending_goes_to_the_end(run, tmp_path):
    (tmp_path / "other" / "log.txt").write_text("one\n")
    result, _, text = run(
        'FILE *f = fopen("G:log.txt", "a+"); fgets(text, 100, f); rewind(f);'
        'fputs("two\\n", f); fputs("three", f); rewind(f);'
        "result = fread(text, 1, 100, f); text[result] = 0; fclose(f);"
    )
    assert (result, text) == (13, "one\ntwo\nthree")


def test_items_are_scanned_one_after_the_other(run, tmp_path):
    (tmp_path / "disk" / "in.txt").write_text("x = 12 , 3.5 tail\nnext")
    result, error, text = run(
        'FILE *f = fopen("in.txt", "r"); int number; double real;'
        'result = fscanf(f, "x = %d , %lf", &number, &real) * 1000 + number * 10 + (int)(2 * real);'
        'error = fscanf(f, "%s", text); error = error * 10 + fscanf(f, "%s", text + 50);'
        'error = error * 10 + fscanf(f, "%s", text); strcat(text, text + 50); fclose(f);'
    )
    assert (result, error, text) == (2127, 109, "tailnext")


@pytest.mark.parametrize(
    ("act", "expected"),
    [
        ('fopen("F:/none.txt", "r") == 0', "ENOENT"),
        ('fopen("F:/../main/main.c", "r") == 0', "EACCES"),
        ('fopen("/etc/passwd", "r") == 0', "ENOENT"),
        ('fopen("H:/a", "w") == 0', "ENODEV"),
        ('fopen("F:/", "r") == 0', "EISDIR"),
        ('fopen("F:/a", "q") == 0', "EINVAL"),
        ('access("F:/none", F_OK) == -1', "ENOENT"),
        ('rename("F:/none", "F:/b") == -1', "ENOENT"),
    ],
)
def test_what_cannot_be_done_is_told_by_errno(run, act, expected):
    result, _, _ = run(f"result = {act} && errno == {expected};")
    assert result == 1


def test_without_a_device_there_are_no_files(run):
    assert run('result = fopen("a", "w") == 0; error = errno == ENODEV;', "")[:2] == (1, 1)
    texts = [entry.text for entry in run.controller.logbook]
    assert any("no such file device" in text and "[library.FileIO]" in text for text in texts)


def test_no_more_files_than_there_is_room_for(run):
    result, error, _ = run(
        'for (result = 0; fopen("F:/a", "w"); result++) if (result > 100) break;'
        "error = errno == EMFILE;"
    )
    assert (result, error) == (16, 1)


def test_a_boot_closes_what_is_open(run):
    run('result = fopen("F:/a", "w") != 0;')
    for _ in range(20):
        run.controller.run(cycles=2)
        assert run.controller.state is State.SERVICE
        run.controller.boot()
        assert run.controller.tags.read(run.controller.tags.find("main.result")) == 1
