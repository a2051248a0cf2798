"""``plcsim completion``: a script that lets a shell complete commands, options and files.

The script holds all words, so that a shell need not start Python at every TAB.
"""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

from plcsim.cli.command_tree import ArgumentKind, Command, CommandArgument, command_tree
from plcsim.cli.exit_codes import epilog

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Iterator


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "completion",
        help="let bash, zsh or fish complete the commands",
        description="Print a script that lets a shell complete commands, options and files. Print "
        "it again after an update.",
        examples=(
            ("plcsim completion bash > ~/.local/share/bash-completion/completions/plcsim", ""),
            ("plcsim completion zsh > ~/.zfunc/_plcsim", "with fpath+=~/.zfunc before compinit"),
            ("plcsim completion fish > ~/.config/fish/completions/plcsim.fish", ""),
        ),
        epilog=epilog(DONE="", WRONG_USAGE=""),
    )
    parser.add_argument("shell", choices=list(SHELLS), metavar="SHELL", help=", ".join(SHELLS))
    parser.set_defaults(func=completion)


def completion(options: argparse.Namespace) -> int:
    """Print the script."""
    from plcsim.cli.command import build_parser  # noqa: PLC0415  # which imports this module

    print("\n".join(SHELLS[options.shell](command_tree(build_parser()))))
    return 0


def _name(command: Command) -> str:
    return " ".join(command.path)


def _steps(root: Command) -> str:
    """Return a pattern of all words that lead from one command to one below it."""
    paths = [command.path for command in root.walk() if command.path]
    return " | ".join(f'"{" ".join(path[:-1])} {path[-1]}"' for path in paths)


def _valued(command: Command) -> Iterator[tuple[str, CommandArgument]]:
    """Iterate over the options that take a value, as a pattern, with what they are."""
    for argument in command.arguments:
        if argument.flags and argument.kind is not ArgumentKind.NOTHING:
            flags = (f'"{_name(command)} {flag}"' for flag in argument.flags)
            yield " | ".join(flags), argument


def _words(command: Command) -> list[str]:
    """Return the commands, choices and options that may stand next."""
    free = [a for a in command.arguments if not a.flags]
    choices = [choice for argument in free for choice in argument.choices]
    flags = [flag for argument in command.arguments for flag in argument.flags]
    return [*(inner.path[-1] for inner in command.commands), *choices, *flags]


def _takes(command: Command) -> ArgumentKind:
    """Return whether files or folders may stand next."""
    kinds = {argument.kind for argument in command.arguments if not argument.flags}
    return (
        ArgumentKind.FILE
        if ArgumentKind.FILE in kinds
        else ArgumentKind.FOLDER
        if ArgumentKind.FOLDER in kinds
        else ArgumentKind.TEXT
    )


# bash

_BASH_FILES = {ArgumentKind.FILE: "-f", ArgumentKind.FOLDER: "-d"}


def bash(root: Command) -> Iterator[str]:
    """Iterate over the lines of the script for bash."""
    yield "# completion of plcsim for bash"
    yield "_plcsim() {"
    yield '    local cur="${COMP_WORDS[COMP_CWORD]}" command="" words="" files="" i'
    yield "    for ((i = 1; i < COMP_CWORD; i++)); do"
    yield '        case "$command ${COMP_WORDS[i]}" in'
    yield f'        {_steps(root)}) command="${{command:+$command }}${{COMP_WORDS[i]}}" ;;'
    yield "        esac"
    yield "    done"
    yield '    case "$command ${COMP_WORDS[COMP_CWORD - 1]}" in'
    for command in root.walk():
        for pattern, argument in _valued(command):
            yield f"    {pattern}) {_bash_value(argument)} ;;"
    yield '    *) case "$command" in'
    for command in root.walk():
        files = _BASH_FILES.get(_takes(command), "")
        yield f'        "{_name(command)}") words="{" ".join(_words(command))}" files="{files}" ;;'
    yield "        esac ;;"
    yield "    esac"
    yield "    COMPREPLY=()"
    yield '    [[ -n $words ]] && mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")'
    yield "    if [[ -n $files && $cur != -* ]]; then"
    yield "        compopt -o filenames 2>/dev/null"
    yield '        mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen "$files" -- "$cur")'
    yield "    fi"
    yield "}"
    yield "complete -F _plcsim plcsim"


def _bash_value(argument: CommandArgument) -> str:
    return f'words="{" ".join(argument.choices)}" files="{_BASH_FILES.get(argument.kind, "")}"'


# zsh

_ZSH_FILES = {ArgumentKind.FILE: "_files", ArgumentKind.FOLDER: "_files -/"}


def zsh(root: Command) -> Iterator[str]:
    """Iterate over the lines of the script for zsh."""
    yield "#compdef plcsim"
    yield "_plcsim() {"
    yield '    local command="" word'
    yield "    local -i none=1  # a completion function fails where it has nothing to offer"
    yield "    local -a inner flags"
    yield "    for word in ${words[2,CURRENT - 1]}; do"
    yield '        case "$command $word" in'
    yield f'        ({_steps(root)}) command="${{command:+$command }}$word" ;;'
    yield "        esac"
    yield "    done"
    yield '    case "$command ${words[CURRENT - 1]}" in'
    for command in root.walk():
        for pattern, argument in _valued(command):
            yield f"    ({pattern}) {_zsh_value(argument)}; return ;;"
    yield "    esac"
    yield '    case "$command" in'
    for command in root.walk():
        yield f'    ("{_name(command)}")'
        yield f"        inner=({' '.join(_zsh_inner(command))})"
        yield f"        flags=({' '.join(_zsh_flags(command))})"
        yield "        (( $#inner )) && _describe command inner && none=0"
        if files := _ZSH_FILES.get(_takes(command)):
            yield f"        [[ $PREFIX != -* ]] && {files} && none=0"
        yield "        ;;"
    yield "    esac"
    yield "    [[ $PREFIX == -* ]] && _describe -o option flags && none=0"
    yield "    return none"
    yield "}"
    yield 'if [[ $funcstack[1] == _plcsim ]]; then _plcsim "$@"; else compdef _plcsim plcsim; fi'


def _zsh_value(argument: CommandArgument) -> str:
    if argument.kind is ArgumentKind.CHOICE:
        return f"compadd -- {shlex.join(argument.choices)}"
    return _ZSH_FILES.get(argument.kind) or f"_message {shlex.quote(argument.metavar)}"


def _zsh_inner(command: Command) -> Iterator[str]:
    for inner in command.commands:
        yield shlex.quote(f"{inner.path[-1]}:{_one_line(inner.text)}")
    for argument in command.arguments:
        if not argument.flags:
            yield from map(shlex.quote, argument.choices)


def _zsh_flags(command: Command) -> Iterator[str]:
    for argument in command.arguments:
        for flag in argument.flags:
            yield shlex.quote(f"{flag}:{_one_line(argument.text)}")


def _one_line(text: str) -> str:
    return " ".join(text.split()).replace(":", " -")


# fish

_FISH_FILES = {
    ArgumentKind.FILE: "__fish_complete_path",
    ArgumentKind.FOLDER: "__fish_complete_directories",
}


def fish(root: Command) -> Iterator[str]:
    """Iterate over the lines of the script for fish."""
    yield "# completion of plcsim for fish"
    yield "function __plcsim_command"
    yield "    set -l path ''"
    yield "    for word in (commandline -opc)[2..-1]"
    yield '        switch "$path $word"'
    yield f"            case {_steps(root).replace(' | ', ' ')}"
    yield '                set path (string trim -- "$path $word")'
    yield "        end"
    yield "    end"
    yield '    test "$path" = "$argv"'
    yield "end"
    yield "complete -c plcsim -f"
    for command in root.walk():
        begin = f"complete -c plcsim -n {shlex.quote(f'__plcsim_command {_name(command)}'.strip())}"
        for inner in command.commands:
            yield f"{begin} -a {inner.path[-1]} -d {_fish_text(inner.text)}"
        for argument in command.arguments:
            yield f"{begin} {_fish_argument(argument)}"


def _fish_argument(argument: CommandArgument) -> str:
    names = [f"-l {f[2:]}" if f.startswith("--") else f"-s {f[1:]}" for f in argument.flags]
    if argument.kind is ArgumentKind.CHOICE:
        value = f"-a {shlex.quote(' '.join(argument.choices))}"
    else:
        finder = _FISH_FILES.get(argument.kind)
        value = f"-a '({finder})'" if finder else ""
    takes = "-x" if argument.flags and argument.kind is not ArgumentKind.NOTHING else ""
    return " ".join(filter(None, [*names, takes, value, f"-d {_fish_text(argument.text)}"]))


def _fish_text(text: str) -> str:
    quoted = " ".join(text.split()).replace("\\", "\\\\").replace("'", "\\'")
    return f"'{quoted}'"


SHELLS: dict[str, Callable[[Command], Iterator[str]]] = {"bash": bash, "zsh": zsh, "fish": fish}
"""The scripts by the shell that they are for."""
