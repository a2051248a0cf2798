"""``plcsim completion``: scripts that the shells themselves are asked about.

bash is everywhere; zsh and fish are asked where they are installed.
"""

import shutil
import subprocess

import pytest

from plcsim.cli.main import main

ASK_BASH = """
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_plcsim
printf '%s\\n' "${COMPREPLY[@]}"
"""

ASK_FISH = """
source $argv[1]
complete -C $argv[2]
"""


# zsh completes on a terminal only; here its own helpers are replaced by some that print.
ASK_ZSH = """
compdef() { }
compadd() { shift; print -rl -- "$@" }
_describe() { print -rl -- "${(@)${(@P)@[-1]}%%:*}" }
_files() { if [[ $1 == -/ ]] { print -rl -- $PREFIX*(N/) } else { print -rl -- $PREFIX*(N) } }
_message() { }  # what is typed freely
source "$1"; shift
words=("$@") CURRENT=$# PREFIX=${@[-1]}
_plcsim
"""


def needs(shell):
    reason = f"{shell} is not installed"
    return pytest.param(shell, marks=pytest.mark.skipif(not shutil.which(shell), reason=reason))


@pytest.fixture
def script(tmp_path, capsys):
    """``script(shell)``: the file with the script for a shell."""

    def script(shell):
        assert main(["completion", shell]) == 0
        file = tmp_path / f"plcsim.{shell}"
        file.write_text(capsys.readouterr().out)
        return file

    return script


@pytest.fixture
def ask(script, tmp_path):
    """``ask(shell, "plcsim", "ru")``: what the shell offers for the last word, with any text."""
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "my plc").mkdir()
    (tmp_path / "here" / "tags.csv").touch()

    def ask(shell, *words):
        file = script(shell)
        command = {
            "bash": ["bash", "--norc", "-c", ASK_BASH, "bash", file, *words],
            "zsh": ["zsh", "-f", "-c", ASK_ZSH, "zsh", file, *words],
            "fish": ["fish", "--no-config", "-c", ASK_FISH, file, " ".join(words)],
        }[shell]
        found = subprocess.run(
            command, capture_output=True, text=True, check=True, cwd=tmp_path / "here", timeout=100
        )
        assert found.stderr == ""
        offered = {line.partition("\t")[0] for line in found.stdout.splitlines()} - {""}
        return {each for each in offered if each.startswith(words[-1])}

    return ask


ALL = [needs("bash"), needs("zsh"), needs("fish")]


@pytest.mark.parametrize("shell", ALL)
@pytest.mark.parametrize(
    ("words", "offered"),
    [
        (["plcsim", "ru"], {"run"}),
        (["plcsim", "types", "lay"], {"layout"}),
        (["plcsim", "run", "--vir"], {"--virtual"}),
        (["plcsim", "run", "x", "--vir"], {"--virtual"}),
        (["plcsim", "tags", "export", "--format", "js"], {"json"}),
        (["plcsim", "completion", "f"], {"fish"}),
        (["plcsim", "run", "--for", ""], set()),
        (["plcsim", "report", "compare", "tag"], {"tags.csv"}),
        (["plcsim", "tags", "export", "-o", "tag"], {"tags.csv"}),
    ],
)
def test_a_shell_offers_what_may_stand_next(ask, shell, words, offered):
    assert ask(shell, *words) == offered


@pytest.mark.parametrize("shell", ALL)
def test_a_shell_offers_folders_in_the_place_of_a_project(ask, shell):
    found = {each.rstrip("/").replace("\\", "") for each in ask(shell, "plcsim", "run", "m")}
    assert found == {"my plc"}


def test_bash_offers_all_commands_and_options_where_nothing_is_typed(ask):
    assert {"run", "check", "new", "--version"} <= ask("bash", "plcsim", "")


@pytest.mark.parametrize("shell", ALL)
def test_a_shell_finds_no_mistake_in_its_script(script, shell):
    done = subprocess.run([shell, "-n", script(shell)], capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
