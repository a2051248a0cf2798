"""The files of a program or a library in Structured Text, read, and parsed where it is needed."""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError
from plcsim.program.structured_text.check.declared import declarations_of
from plcsim.program.structured_text.code_cache import code_cache
from plcsim.program.structured_text.codegen.storage import compiler
from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.dialect import is_standard
from plcsim.program.structured_text.languages.readers import parse_units
from plcsim.program.structured_text.names import NAME, language_of
from plcsim.program.structured_text.program_uses import (
    NO_USES,
    ProgramUses,
    program_uses,
    without_comments,
)
from st_types.errors import DiagnosticSeverity, SourceError
from st_types.resolve.dialect import AUTOMATION_STUDIO, IEC
from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.lexer import Tokens
from st_types.syntax.source import Source
from st_types.syntax.tree import DeclarationFile

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    from plcsim.program.structured_text.syntax.tree import StructuredTextFile
    from st_types.resolve.dialect import Dialect

_DECLARING: Final = re.compile(
    r"\b(?:VAR(?:_\w+)?|TYPE|FUNCTION(?:_BLOCK)?|CONFIGURATION|INITIAL_STEP)\b", re.IGNORECASE
)


class UnitFile:
    """A file with units.

    Args:
        source: its text.
    """

    def __init__(self, source: Source) -> None:
        self.source = source

    @property
    def path(self) -> str:
        """The file, as the user named it."""
        return self.source.path

    @cached_property
    def parsed(self) -> StructuredTextFile:
        """The parsed file; what is wrong in its text is in its ``diagnostics``."""
        return parse_units(self.source)

    @property
    def may_declare(self) -> bool:
        """False where no word in the text could begin a declaration."""
        return not self._is_silent and self._has_declaring_words

    @cached_property
    def _has_declaring_words(self) -> bool:
        if language_of(self.path) != NAME:  # whose words are others
            return bool(declarations_of(self.parsed).items)
        return _DECLARING.search(without_comments(self.source.text)) is not None

    def declarations(self, uses: ProgramUses = NO_USES) -> UnitDeclarations:
        """Return what the file declares for all of its program.

        Args:
            uses: which of its PROGRAMs others name, so that they are declared, too.

        A file that declares nothing, and whose text was parsed without errors before, is not parsed
        for that.
        """
        if not self._is_silent:
            made = declarations_of(self.parsed, uses)
            return UnitDeclarations(made.items, "", made.tokens, made.diagnostics, self)
        nothing = Source(self.path, "")
        log = DiagnosticLog(nothing, FindingCode.SYNTAX)
        return UnitDeclarations([], "", Tokens(nothing), log, self)

    @cached_property
    def _is_silent(self) -> bool:
        """Whether it declares nothing, and its syntax has no errors; that is kept on disk."""
        text = f"{language_of(self.path)}\0{self.source.text}".encode("utf-8", "surrogatepass")
        key = f"syntax-{hashlib.blake2b(compiler() + text, digest_size=20).hexdigest()}"
        cache = code_cache()
        if cache.load(key) is not None:
            return True
        is_silent = not (self._has_declaring_words or self.parsed.diagnostics.records)
        if is_silent:
            cache.store(key, b"")
        return is_silent


@dataclass(slots=True, repr=False)
class UnitDeclarations(DeclarationFile):
    """What a file with units declares."""

    unit_file: UnitFile = field(compare=False)


def declared_in(paths: Iterable[Path]) -> list[UnitDeclarations]:
    """Return what files with units declare.

    Raises:
        ConfigurationError: a file cannot be read.
    """
    files = read_files(paths)
    uses = program_uses(file.source.text for file in files)
    return [file.declarations(uses) for file in files]


def dialect_of(declared: Sequence[DeclarationFile]) -> Dialect:
    """Return the rules of a program whose files declare this."""
    files = [each.unit_file for each in declared if isinstance(each, UnitDeclarations)]
    standard = any(file.may_declare and is_standard(file.parsed) for file in files)
    return IEC if standard else AUTOMATION_STUDIO


def read_files(files: Iterable[Path]) -> list[UnitFile]:
    """Read files.

    Raises:
        ConfigurationError: a file cannot be read.
    """
    try:
        return [UnitFile(Source.read(file)) for file in files]
    except (OSError, SourceError) as err:
        raise ConfigurationError(str(err)) from None


def check_syntax(files: Iterable[UnitFile]) -> None:
    """Raise a ConfigurationError with all errors that parsing finds."""
    records = [record for file in files for record in file.parsed.diagnostics.records]
    errors = [record.render() for record in records if record.severity is DiagnosticSeverity.ERROR]
    if errors:
        raise ConfigurationError(*errors)
