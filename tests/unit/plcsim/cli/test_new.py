"""``plcsim new``: copies of the examples, which check, and one that runs and tests itself."""

import subprocess
import sys

import pytest

from plcsim.ansi_c.toolchain import system_clang, zig
from plcsim.cli.main import main
from plcsim.cli.new import _examples

EXAMPLES = sorted(_examples())


@pytest.fixture(autouse=True)
def empty_folder(tmp_path, monkeypatch):
    """The commands run in a folder of their own."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_there_are_examples():
    assert {"blinky", "tcp_server"} <= set(EXAMPLES)


def test_a_new_project_runs_and_tests_itself(empty_folder, capsys):
    assert main(["new", "my_plc"]) == 0
    assert capsys.readouterr().out == (
        "Made my_plc from the example blinky. Try:\n"
        "    plcsim run my_plc\n"
        "    python3 -m pytest my_plc/tests\n"
    )
    assert main(["run", "my_plc", "--virtual", "--cycles", "3", "--quiet"]) == 0
    done = pytest_of("my_plc/tests")
    assert done.returncode == 0, done.stdout


def test_a_new_project_in_structured_text_runs_and_tests_itself(empty_folder, capsys):
    assert main(["new", "my_plc", "--language", "st"]) == 0
    assert "from the example blinky_st." in capsys.readouterr().out
    assert (empty_folder / "my_plc" / "blinky" / "Main.st").is_file()
    assert main(["run", "my_plc", "--virtual", "--cycles", "3", "--quiet"]) == 0
    done = pytest_of("my_plc/tests")
    assert done.returncode == 0, done.stdout


def test_a_new_project_in_c_runs_and_tests_itself(empty_folder, capsys):
    if zig() is None and system_clang() is None:
        pytest.skip("no compiler for C is installed")
    assert main(["new", "my_plc", "--language", "c"]) == 0
    assert "from the example blinky_c." in capsys.readouterr().out
    assert (empty_folder / "my_plc" / "blinky" / "Main.c").is_file()
    assert main(["run", "my_plc", "--virtual", "--cycles", "3", "--quiet"]) == 0
    done = pytest_of("my_plc/tests")
    assert done.returncode == 0, done.stdout


def pytest_of(*arguments):
    """The result of pytest in a process of its own."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("arguments", [[], ["first/tests", "second/tests"]])
def test_two_projects_in_one_repository_are_tested_together(empty_folder, arguments):
    for name in ("first", "second"):
        main(["new", name])
    done = pytest_of("-k", "lamp_is_off", *arguments)
    assert "2 passed" in done.stdout, done.stdout


def test_tests_of_the_same_name_do_not_matter_where_pytest_ini_is_heard(empty_folder):
    for name in ("first", "second"):
        main(["new", name])
        (empty_folder / name / "tests" / "test_more.py").write_text("def test_more(plc): pass\n")
    done = pytest_of("-k", "more", "first/tests", "second/tests")
    assert "2 passed" in done.stdout, done.stdout


def test_a_new_project_is_a_repository_of_its_own(empty_folder):
    main(["new", "My-plc"])
    assert (empty_folder / "My-plc" / "tests" / "test_my_plc.py").is_file()
    assert "__pycache__/" in (empty_folder / "My-plc" / ".gitignore").read_text().splitlines()
    assert '# name = "My-plc"' in (empty_folder / "My-plc" / "plc.toml").read_text()


def test_mypy_takes_the_folder_for_a_package(empty_folder):
    main(["new", "first"])
    main(["new", "My-plc"])
    assert not (empty_folder / "My-plc" / "mypy.ini").exists()
    (empty_folder / "first" / "shared.py").write_text("STEP = 'x'\n")
    program = empty_folder / "first" / "blinky" / "main.py"
    program.write_text(
        "from plcsim import Program\nfrom st_types import UINT, var\n\n"
        "from ..shared import STEP\n\n\nclass Blinky(Program):\n    n = var(UINT)\n\n"
        "    def cyclic(self) -> None:\n        self.n = STEP\n"
    )
    command = [sys.executable, "-c", "import sys, mypy.api\nprint(mypy.api.run([])[0])"]
    done = subprocess.run(
        command, cwd=empty_folder / "first", capture_output=True, text=True, check=False
    )
    assert (
        'blinky/main.py:11: error: Incompatible types in assignment (expression has type "str"'
        in (done.stdout)
    )
    assert "Found 1 error" in done.stdout


def test_what_to_try_can_be_typed_as_it_is(empty_folder, capsys, monkeypatch):
    (empty_folder / "mein plc").mkdir()
    monkeypatch.setattr("plcsim.cli.new.find_spec", lambda _: None)
    assert main(["new", "mein plc/cell"]) == 0
    assert capsys.readouterr().out.splitlines()[1:] == [
        "    plcsim run 'mein plc/cell'",
        "    python3 -m pip install pytest hypothesis",
        "    python3 -m pytest 'mein plc/cell/tests'",
    ]


@pytest.mark.parametrize("example", EXAMPLES)
def test_every_example_can_be_copied_and_is_right(example, empty_folder, capsys):
    assert main(["new", "copy", "--like", example]) == 0
    assert not list(empty_folder.glob("**/__pycache__"))
    assert main(["check", "copy"]) == 0


def test_an_existing_folder_is_left_alone(empty_folder, capsys):
    target = empty_folder / "mine"
    target.mkdir()
    (target / "notes.txt").write_text("keep")
    assert main(["new", "mine"]) == 1
    assert capsys.readouterr().err == "plcsim: mine: exists already; nothing was changed\n"
    assert [f.name for f in target.iterdir()] == ["notes.txt"]


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (["x", "--like", "nothing"], "--like nothing: no such example; there are"),
        (["my plc"], "'my plc' cannot be the name of a project"),
        (["1st"], "'1st' cannot be the name of a project"),
        (["händler"], "'händler' cannot be the name of a project: a letter of A to Z"),
        ([".."], "..: exists already; nothing was changed"),
        (["."], ".: exists already; nothing was changed"),
        (["no/where"], "no/where: there is no folder no"),
        (["dangling"], "dangling: cannot be made"),
    ],
)
def test_what_is_refused(arguments, error, empty_folder, capsys):
    (empty_folder / "dangling").symlink_to("nowhere/at/all")
    assert main(["new", *arguments]) == 1
    assert capsys.readouterr().err.startswith(f"plcsim: {error}")
    assert [f.name for f in empty_folder.iterdir()] == ["dangling"]
