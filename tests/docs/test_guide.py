"""The pages of docs/guide are typed in as they stand: every file, every command, every output.

A page is a session in a shell, from top to bottom, in an empty folder:

- ``File `path`:`` before a block: the block is written to that file.
- a block of ``sh``: its commands are run; each must succeed.
- a block of ``text`` after it: lines that the commands print, in this order; ``...`` stands for
  anything. Without commands before it, it is a picture and means nothing here.
- a block of ``mermaid`` is a picture, too. There are no other blocks: an example that nobody runs
  is soon wrong.
"""

import configparser
import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from plcsim.cli.command import build_parser
from plcsim.cli.exit_codes import ExitCode
from plcsim.cli.run import run

LONGEST_PAGE_S = 800
"""A page is a dozen and more of processes; on a busy host they take their time."""

pytestmark = pytest.mark.timeout(LONGEST_PAGE_S + 100)

GUIDE = Path(__file__).parents[2] / "docs" / "guide"
PAGES = sorted(GUIDE.glob("*.md"))

_BLOCK = re.compile(
    r"(?:^File `(?P<file>[^`]+)`:\n\n)?^```(?P<kind>\w*)\n(?P<text>.*?)^```$",
    re.DOTALL | re.MULTILINE,
)
MARK = "\x1e"
PICTURES = {"mermaid"}


class Block(NamedTuple):
    """A block of a page: "file" with its path, "sh" or "text"."""

    kind: str
    text: str
    path: str = ""


def blocks_of(page: str) -> list[Block]:
    blocks = []
    for found in _BLOCK.finditer(page):
        if found["file"]:
            blocks.append(Block("file", found["text"], found["file"]))
        elif found["kind"] in ("sh", "text"):
            blocks.append(Block(found["kind"], found["text"]))
        else:
            assert found["kind"] in PICTURES, f"nobody runs this block:\n{found[0]}"
    return blocks


def script_of(blocks: list[Block]) -> str:
    """Return a page as one script that prints a mark after each block of commands."""
    lines = ["set -euo pipefail"]
    for block in blocks:
        if block.kind == "file":
            folder = Path(block.path).parent
            lines += [f"mkdir -p '{folder}'", f"cat > '{block.path}' <<'END_OF_FILE'"]
            lines += [block.text.rstrip("\n"), "END_OF_FILE"]
        elif block.kind == "sh":
            lines += [block.text.rstrip("\n"), f"printf '{MARK}'"]
    return "\n".join(lines) + "\n"


def misfit(expected: str, printed: str) -> str:
    """Return the first line that was expected and not printed, "" where all were."""
    rest = iter([line.rstrip() for line in printed.splitlines()])
    for line in filter(None, map(str.rstrip, expected.splitlines())):
        pattern = ".*".join(map(re.escape, line.split("...")))
        if line != "..." and not any(re.fullmatch(pattern, each) for each in rest):
            return line
    return ""


@pytest.fixture
def shell(tmp_path, monkeypatch):
    """``shell(script)``: exit code and output of a script where plcsim is installed."""
    programs = tmp_path / "bin"
    programs.mkdir()
    for name, arguments in (("python3", ""), ("plcsim", " -P -m plcsim")):
        program = programs / name
        program.write_text(f'#!/bin/sh\nexec "{sys.executable}"{arguments} "$@"\n')
        program.chmod(0o755)
    (tmp_path / "work").mkdir()
    settings = {"PATH": f"{programs}:{os.environ['PATH']}", "PYTEST_ADDOPTS": "-p no:cacheprovider"}

    def shell(script):
        done = subprocess.run(
            ["bash", "-c", script],
            cwd=tmp_path / "work",
            env=os.environ | settings | {"XDG_RUNTIME_DIR": str(tmp_path), "COLUMNS": "100"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            text=True,
            timeout=LONGEST_PAGE_S,
            check=False,
        )
        return done.returncode, done.stdout

    return shell


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_page_keeps_its_word(page, shell):
    blocks = blocks_of(page.read_text("utf-8"))
    code, output = shell(script_of(blocks))
    assert code == 0, output
    printed = iter(output.split(MARK))
    said = None
    for block in blocks:
        if block.kind == "sh":
            said = next(printed)
        elif block.kind == "text" and said is not None:
            assert not misfit(block.text, said), said


# the reader of pages itself

PAGE = """\
File `a/b.txt`:

```text
one
```

```sh
cat a/b.txt
echo two
```

```text
one
t...o
```

```mermaid
pictures
```
"""


def test_a_page_is_typed_in_from_top_to_bottom(shell):
    blocks = blocks_of(PAGE)
    assert [(block.kind, block.path) for block in blocks] == [
        ("file", "a/b.txt"),
        ("sh", ""),
        ("text", ""),
    ]
    assert shell(script_of(blocks)) == (0, f"one\ntwo\n{MARK}")


@pytest.mark.parametrize(
    ("expected", "missing"),
    [
        ("one\nthree", ""),
        ("...\nthree\n", ""),
        ("t...e\n", ""),
        ("three\none", "one"),
        ("one\ntw", "tw"),
        ("one?", "one?"),
    ],
)
def test_output_is_compared_line_by_line_in_order(expected, missing):
    assert misfit(expected, "one\ntwo  \nthree\n") == missing


def test_an_example_that_nobody_runs_is_refused():
    with pytest.raises(AssertionError, match="nobody runs this block"):
        blocks_of("```python\n1 // 0\n```\n")


def test_a_command_that_fails_ends_the_page(shell):
    code, output = shell(script_of(blocks_of("```sh\nfalse\necho here\n```\n")))
    assert code != 0
    assert "here" not in output


def test_there_are_pages():
    assert len(PAGES) >= 5


# what cannot be run here is compared with what plcsim understands


@pytest.fixture(scope="module")
def deployment():
    """The files of the page about real hosts."""
    page = (GUIDE / "deployment.md").read_text("utf-8")
    return {block.path: block.text for block in blocks_of(page) if block.kind == "file"}


def parse(command):
    """What plcsim makes of a command line."""
    program, *words = command
    assert Path(program).name == "plcsim"
    return build_parser().parse_args(words)


def test_the_unit_of_systemd_starts_what_there_is(deployment):
    unit = configparser.ConfigParser(strict=False, interpolation=None)
    unit.optionxform = str
    unit.read_string(deployment["plcsim@.service"])
    options = parse(shlex.split(unit["Service"]["ExecStart"]))
    assert (options.project, options.report) == (Path("/srv/plc/%i"), Path("/var/lib/plc/%i.json"))
    codes = {int(code) for code in unit["Service"]["RestartPreventExitStatus"].split()}
    assert codes == {ExitCode.FAILED, ExitCode.WRONG_USAGE, ExitCode.SERVICE}


def test_the_container_runs_what_there_is(deployment):
    lines = [line.partition(" ") for line in deployment["Dockerfile"].splitlines()]
    told = {instruction: rest for instruction, _, rest in lines}
    assert parse(json.loads(told["CMD"])).func is run
    assert told["RUN"] == "plcsim check"
    assert told["STOPSIGNAL"] == "SIGINT"
