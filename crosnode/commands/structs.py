"""What ``plcsim types from-ros`` and ``to-ros`` do."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from crosnode.commands.message_types import message_types
from crosnode.messages.struct_declarations import (
    Bounds,
    print_constants,
    print_types,
    struct_declarations,
)
from crosnode.messages.struct_messages import messages_from_struct
from plcsim.cli.type_commands import find_types
from plcsim.core.errors import PlcError
from st_types.types.derived import StructType, resolve_alias

if TYPE_CHECKING:
    import argparse
    from pathlib import Path


def from_ros(options: argparse.Namespace) -> None:
    """Print or write the STRUCTs of messages, services and actions."""
    types = message_types(options.path)
    found = struct_declarations(types, options.types, Bounds(options.array, options.string))
    if options.output is None:
        sys.stdout.write(print_types(found) + print_constants(found))
        return
    for each in found:  # a file for each, so that no two commands declare one STRUCT twice
        _write(options.output / f"{each.name}.typ", each.typ())
        if constants := each.var():
            _write(options.output / f"{each.name}.var", constants)


def _write(file: Path, text: str) -> None:
    """Write a file; one that is there stays, for its bounds may have been changed by hand."""
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        if file.exists():
            is_same = file.read_text(encoding="utf-8", errors="replace") == text
            note = "is there already" if is_same else "differs and stays as it is"
            sys.stderr.write(f"{file}: {note}\n")
            return
        file.write_text(text, encoding="utf-8")
    except OSError as err:
        raise PlcError(f"{file}: {err.strerror or err}.") from err
    sys.stdout.write(f"{file}\n")


def to_ros(options: argparse.Namespace) -> None:
    """Print the messages of a STRUCT, those that it contains first."""
    for title, found in find_types(options.paths, options.type):
        data_type = resolve_alias(found)
        if not isinstance(data_type, StructType):
            raise PlcError(f"{title} is no STRUCT.")
        for name, text in messages_from_struct(data_type, options.package).items():
            sys.stdout.write(f"# {name}\n{text}\n")
