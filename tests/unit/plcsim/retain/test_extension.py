"""What a run has left is there at the next start, as far as it fits."""

import textwrap
from pathlib import Path

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError
from plcsim.project.assembly import load, still_controller
from plcsim.project.extension import check_settings
from plcsim.project.plc_toml import read_project
from plcsim.retain.service import Keeper
from plcsim.testing.target import open_plc

from .conftest import PRESS

BOTTLING = Path(__file__).parents[3] / "data" / "automation_studio" / "Bottling"


def ran(site, cycles=3):
    """Run for some cycles, and let the service end."""
    controller, service = site.start()
    controller.run(cycles=cycles)
    service.is_stopping = True
    Keeper(service).run()
    return controller


def value(controller, path):
    return controller.tags.read(controller.tags.find(path))


def logged(controller):
    return [e.text for e in controller.logbook if e.source == "retain"]


def test_the_next_run_goes_on_where_the_last_one_ended(site):
    assert logged(ran(site)) == ["there is nothing yet: initial values are used"]
    controller, _ = site.start()
    assert [value(controller, p) for p in ("press.parts", "press.began", "gTotal")] == [8, 8, 6]
    assert logged(controller) == []


def test_a_cold_start_gives_it_up(site):
    ran(site)
    controller, _ = site.start(cold=True)
    assert [value(controller, p) for p in ("press.parts", "gTotal", "gName")] == [5, 0, "one"]


def test_what_does_not_fit_is_listed_and_kept_aside(site):
    ran(site)
    before = (site.retain / "retained.1").read_bytes()
    site.write(PRESS.replace("UDINT", "INT"))
    controller, _ = site.start()
    assert (value(controller, "press.parts"), value(controller, "gTotal")) == (5, 6)
    lost, kept = logged(controller)
    assert lost == "press.parts: it was UDINT and is INT; its value is not taken"
    assert "retained.1.left" in kept
    assert (site.retain / "retained.1.left").read_bytes() == before


def test_a_long_list_is_cut(site):
    table = "\n".join(f"    x{n} = var(UDINT, retain=True)" for n in range(30))
    site.write(PRESS.replace("    began", f"{table}\n    began"))
    ran(site)
    site.write()
    controller, _ = site.start()
    lines = logged(controller)
    assert len(lines) == 22
    assert lines[20] == "10 more values are not taken"


def test_a_file_that_is_torn_is_told(site):
    ran(site)
    file = site.retain / "retained.1"
    file.write_bytes(file.read_bytes()[:50])
    controller, _ = site.start()
    assert value(controller, "press.parts") == 5
    assert logged(controller)[:2] == [
        f"{file}: it is truncated; it is left out",
        "there is nothing yet: initial values are used",
    ]


def test_check_tells_what_would_not_be_taken(site):
    ran(site)
    site.write(PRESS.replace("UDINT", "INT"))
    assert checked(site) == ["press.parts: it was UDINT and is INT; its value is not taken"]
    site.write(PRESS.replace(", retain=True", ""), "VAR\n\tgTotal : UDINT;\nEND_VAR\n")
    assert checked(site) == ["retain: no variable of the project is RETAIN"]


def checked(site):
    project = read_project(site.folder)
    application = load(project)
    try:
        return check_settings(project.extensions, still_controller(application))
    finally:
        application.unload()


def test_on_the_virtual_clock_nothing_is_read_or_written(site):
    ran(site)
    before = {file: file.read_bytes() for file in site.retain.iterdir()}
    with open_plc(project=site.folder) as plc:
        plc.run("50ms")
        assert plc["press.began"] == 5
    assert {file: file.read_bytes() for file in site.retain.iterdir()} == before


LANGUAGES = {
    "an .st file": {
        "press/main.st": """
            PROGRAM press
            VAR RETAIN
                parts : UDINT := 5;
            END_VAR
            VAR
                began : UDINT;
            END_VAR
                IF began = 0 THEN
                    began := parts;
                END_IF
                parts := parts + 1;
            END_PROGRAM
        """,
    },
    "C": {
        "press/main.c": """
            #include <bur/plctypes.h>
            _LOCAL_RETAIN UDINT parts = 5;
            _GLOBAL_RETAIN UDINT total;
            _LOCAL UDINT began;
            void _INIT init(void) { began = parts; }
            void _CYCLIC cyclic(void) { parts++; total += 2; }
        """,
    },
    "C with a declaration": {
        "press/Variables.var": "VAR RETAIN parts : UDINT := 5; END_VAR VAR began : UDINT; END_VAR",
        "press/main.c": """
            #include <bur/plctypes.h>
            _LOCAL_RETAIN UDINT parts;
            _LOCAL UDINT began;
            void _INIT init(void) { began = parts; }
            void _CYCLIC cyclic(void) { parts++; }
        """,
    },
}


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_language_keeps_its_variables(site, language):
    if language.startswith("C"):
        compiler()
    (site.folder / "press" / "main.py").unlink()
    (site.folder / "Global.var").unlink()
    for name, text in LANGUAGES[language].items():
        (site.folder / name).write_text(textwrap.dedent(text))

    first = ran(site, cycles=4)
    assert (value(first, "press.began"), value(first, "press.parts")) == (5, 9)
    again = ran(site, cycles=1)
    assert (value(again, "press.began"), value(again, "press.parts")) == (9, 10)
    again.shutdown()
    again.boot()  # a warm restart, as a page asks for it
    again.run(cycles=1)
    assert (value(again, "press.began"), value(again, "press.parts")) == (10, 11)
    again.shutdown()
    again.boot(cold=True)
    again.run(cycles=1)
    assert (value(again, "press.began"), value(again, "press.parts")) == (5, 6)
    if language == "C":
        assert [tag.path for tag in again.retained.tags] == ["press.parts", "press.total"]


def compiler():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


def test_permanent_variables_of_cpu_per_outlive_a_cold_start(site):
    for file in (site.folder / "press" / "main.py", site.folder / "Global.var"):
        file.unlink()
    compiler()
    (site.folder / "plc.toml").write_text(f'project = "{BOTTLING}"\n[retain]\n')
    first, service = site.start()
    first.tags.write(first.tags.find("gTotal"), 77)
    first.run(cycles=1)
    service.is_stopping = True
    Keeper(service).run()
    again, _ = site.start(cold=True)
    assert value(again, "gTotal") == 77
    assert [tag.path for tag in again.retained.tags] == ["gTotal"]
