"""Recipes: variables that programs have registered, saved to files and loaded from them."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.core.tag import leaves
from plcsim.library.document import MAX_BYTES
from plcsim.library.fileio.interface import fiERR_FILE_DEVICE
from plcsim.library.fileio.volumes import FileRefusedError, Volumes
from plcsim.library.mapp.errors import (
    NO_FILE_DEVICE,
    NO_FILE_NAME,
    NOT_LOADED,
    NOT_SAVED,
    NOTHING_FOUND,
    NOTHING_REGISTERED,
)
from plcsim.library.mapp.recipe_file import (
    RecipeContent,
    RecipeFileError,
    content_of_csv,
    content_of_xml,
    csv_of,
    xml_of,
)
from plcsim.library.value_text import text_of, value_of
from st_types.errors import ValueRangeError
from st_types.types.derived import ReferenceType

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from plcsim.core.context import Context
    from plcsim.core.tag import Tag
    from plcsim.library.members import BlockVariables

LONGEST_CATEGORY: Final = 50
_HEADER: Final = ("Name", "Description", "Version")


class RegisteredVariable(NamedTuple):
    """A variable that belongs to recipes."""

    tag: Tag
    category: str


class Recipe:
    """The variables of one MpLink, and the files of their values.

    Args:
        context: of the controller.

    Attributes:
        registered: variables by the names that programs gave.
        loads: how often values were loaded: blocks of registered variables tell of it.
        saves: how often a file was written.
        p_device: address of the name of the device that was used last, 0 for none.
        is_csv: its files are CSV.
    """

    def __init__(self, context: Context) -> None:
        self._context = context
        self.registered: dict[str, RegisteredVariable] = {}
        self.loads = 0
        self.saves = 0
        self.p_device = 0
        self.is_csv = False

    def _path(self, p_device: int, p_file: int) -> Path | int:
        """Return the file, or a status."""
        if not p_device:
            return NO_FILE_DEVICE
        if not p_file:
            return NO_FILE_NAME
        try:
            path = self._context.library(Volumes).path(p_device, p_file)
        except FileRefusedError as err:
            return NO_FILE_DEVICE if err.status == fiERR_FILE_DEVICE else NO_FILE_NAME
        return NO_FILE_NAME if path.is_dir() else path

    def _chosen(self, category: str) -> Iterator[tuple[str, Tag]]:
        """Yield the variables of a category, of all for ""."""
        for name, variable in self.registered.items():
            if not category or variable.category == category:
                yield name, variable.tag

    def save(self, p_device: int, p_file: int, category: str, header: Mapping[str, str]) -> int:
        """Write a file; return a status."""
        path = self._path(p_device, p_file)
        if isinstance(path, int):
            return path
        values = {name: dict(self._texts(tag)) for name, tag in self._chosen(category)}
        content = RecipeContent(header, values)
        try:
            path.write_bytes(csv_of(content) if self.is_csv else xml_of(content))
            self._context.library(Volumes).date(path)
            self.saves += 1
        except OSError:
            return NOT_SAVED
        return 0 if values else NOTHING_REGISTERED

    def _texts(self, tag: Tag) -> Iterator[tuple[str, str]]:
        """Yield the values of a variable by the path inside; addresses are left out."""
        memory, inside = self._context.memory, len(tag.path)
        for leaf in leaves(tag):
            if not isinstance(leaf.data_type, ReferenceType):
                value = memory.get(leaf.data_type, leaf.address)
                yield leaf.path[inside:].removeprefix("."), text_of(leaf.data_type, value)

    def load(self, p_device: int, p_file: int, category: str) -> int | RecipeContent:
        """Read a file and store its values; return what it holds, or a status."""
        path = self._path(p_device, p_file)
        if isinstance(path, int):
            return path
        try:
            if not path.is_file() or path.stat().st_size > MAX_BYTES:
                return NOT_LOADED
            data = path.read_bytes()
            content = content_of_csv(data) if self.is_csv else content_of_xml(data)
        except (OSError, RecipeFileError):
            return NOT_LOADED
        found = [self._store(tag, content.values.get(name)) for name, tag in self._chosen(category)]
        if not found:
            return NOTHING_REGISTERED
        if not any(found):
            return NOTHING_FOUND
        self.loads += 1
        return content

    def _store(self, tag: Tag, texts: Mapping[str, str] | None) -> bool:
        """Store the values that a variable has in a file; what does not fit stays as it is."""
        if texts is None:
            return False
        inside = len(tag.path)
        for leaf in leaves(tag):
            text = texts.get(leaf.path[inside:].removeprefix("."))
            if text is not None and not isinstance(leaf.data_type, ReferenceType):
                with suppress(ValueError, ValueRangeError):
                    value: Any = value_of(leaf.data_type, text)
                    self._context.memory.set(leaf.data_type, leaf.address, value)
        return True


class _Recipes:
    """The recipes of a controller, by the addresses of their links."""

    def __init__(self, _context: Context) -> None:
        self.by_link: dict[int, Recipe] = {}


def recipe_of(context: Context, link: int) -> Recipe:
    """Return the recipe that an MpLink leads to."""
    by_link = context.library(_Recipes).by_link
    if link not in by_link:
        by_link[link] = Recipe(context)
    return by_link[link]


def header_texts(variables: BlockVariables) -> dict[str, str]:
    """Return the texts of a header."""
    return {name: variables.own_text(name) for name in _HEADER}


def header_of(content: RecipeContent) -> dict[str, str]:
    """Return the same of what a file holds."""
    return {name: content.header[name] for name in _HEADER if name in content.header}
