"""The blocks of MpRecipe: variables are registered, saved, loaded, and listed for the operator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Final

from plcsim.library.fileio.volumes import FileRefusedError, Volumes
from plcsim.library.mapp.block import MappBlock
from plcsim.library.mapp.command import CommandBlock
from plcsim.library.mapp.errors import (
    NO_SUCH_PV,
    NOT_DELETED,
    PV_NAME_NULL,
    RECIPE_WITHOUT_UICONNECT,
    is_error,
)
from plcsim.library.mapp.recipes import (
    LONGEST_CATEGORY,
    RegisteredVariable,
    header_of,
    header_texts,
    recipe_of,
)
from plcsim.library.members import ReferredStructure, changes, rises
from plcsim.library.sys_lib.tasks import running_name
from plcsim.library.sys_lib.variables import find_variable

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from plcsim.core.context import Context
    from plcsim.core.tag import Tag
    from plcsim.library.mapp.recipes import Recipe
    from plcsim.library.members import BlockVariables, FindType
    from st_types.types.derived import StructType

UPDATE: Final = "UpdateNotification"


class RegisterVariable(MappBlock):
    """MpRecipeRegPar, MpRecipeRegParSync: the variable PVName belongs to the recipe."""

    def seen(self, variables: BlockVariables, link: int) -> tuple[object, ...]:
        """Return which variable it is, and how often it was loaded."""
        name, recipe = variables.text("PVName"), recipe_of(self.context, link)
        return name, recipe.loads, name in recipe.registered

    def call(self, address: int, variables: BlockVariables, link: int) -> None:
        """Register it, and tell for one call that it has new values."""
        recipe = recipe_of(self.context, link)
        name = variables.text("PVName")
        if name not in recipe.registered:
            tag = self._find(name)
            if tag is None:
                status = NO_SUCH_PV if variables.address("PVName") else PV_NAME_NULL
                variables.set(Active=False, Error=True, StatusID=status)
                return
            category = variables.text("Category", LONGEST_CATEGORY)
            recipe.registered[name] = RegisteredVariable(tag, category)
            changes(self.context, address, UPDATE, recipe.loads)
        variables.set(UpdateNotification=changes(self.context, address, UPDATE, recipe.loads))

    def _find(self, name: str) -> Tag | None:
        """Return a variable; a bare name is the calling task's, or else global."""
        if not name:
            return None
        own = (
            None
            if ":" in name
            else find_variable(self.context, f"{running_name(self.context)}:{name}")
        )
        return own or find_variable(self.context, name)

    def rest(self, address: int, variables: BlockVariables) -> None:
        """Tell nothing."""
        variables.set(UpdateNotification=False)


class RecipeFile(CommandBlock):
    """MpRecipeXml: Load and Save a file of the values of registered variables."""

    commands: ClassVar[tuple[str, ...]] = ("Load", "Save")
    is_csv: ClassVar[bool] = False

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._header = ReferredStructure(data_type, "Header")

    def seen(self, variables: BlockVariables, link: int) -> tuple[object, ...]:
        """Return what it is about to do."""
        return self.running(variables), recipe_of(self.context, link).loads

    def call(self, address: int, variables: BlockVariables, link: int) -> None:
        """Take a command, or do the one that was taken."""
        recipe = recipe_of(self.context, link)
        recipe.is_csv = self.is_csv
        recipe.p_device = variables.address("DeviceName")
        if rises(self.context, address, variables, UPDATE):
            recipe.loads += 1
        super().call(address, variables, link)

    def do(self, name: str, address: int, variables: BlockVariables, link: int) -> int:
        """Load or save."""
        recipe = recipe_of(self.context, link)
        p_device, p_file = variables.address("DeviceName"), variables.address("FileName")
        category = variables.text("Category", LONGEST_CATEGORY)
        header = self._header.of(self.context.memory, variables)
        if name == "Save":
            texts = {} if header is None else header_texts(header)
            return recipe.save(p_device, p_file, category, texts)
        found = recipe.load(p_device, p_file, category)
        if isinstance(found, int):
            return found
        if header is not None:
            header.set(**header_of(found))
        variables.set(Info__LastLoadedRecipe=variables.text("FileName"))
        return 0


class CsvFile(RecipeFile):
    """MpRecipeCsv: likewise, in another form."""

    is_csv: ClassVar[bool] = True


_ASKED: Final = ("Recipe.Load", "Recipe.Save", "Recipe.Delete", "New.Create", "Recipe.Refresh")
"""Commands at UIConnect; what is first counts where several rise."""


class RecipeUI(MappBlock):
    """MpRecipeUI: the files of a recipe's device at UIConnect, and what is done with one of them.

    The name of a file is that of the selected line; commands count at their edges, and Status is
    the operation for the call that does it.
    """

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._connect = ReferredStructure(data_type, "UIConnect")

    def seen(self, variables: BlockVariables, link: int) -> tuple[object, ...]:
        """Return what the operator does, the operation shown, and how often a file was written."""
        screen = self._connect.of(self.context.memory, variables)
        recipe = recipe_of(self.context, link)
        asked = () if screen is None else tuple(map(screen.number, (*_ASKED, "Status")))
        return (*asked, recipe.saves, variables.address("DeviceName") or recipe.p_device)

    def call(self, address: int, variables: BlockVariables, link: int) -> None:
        """Take what the operator asks for, and show the files."""
        screen = self._connect.of(self.context.memory, variables)
        if screen is None:
            variables.set(StatusID=RECIPE_WITHOUT_UICONNECT)
            return
        recipe = recipe_of(self.context, link)
        p_device = variables.address("DeviceName") or recipe.p_device
        edges = [name for name in _ASKED if rises(self.context, screen.start, screen, name)]
        status = self._do(edges[0], screen, recipe, p_device) if edges else 0
        kind = edges[0].rpartition(".")[2].upper() if edges else "IDLE"
        screen.set_enumeration("Status", "STATUS_ERROR" if is_error(status) else f"STATUS_{kind}")
        variables.set(Error=is_error(status), StatusID=status)
        self._list(screen, self._files(p_device))

    def _do(self, edge: str, screen: BlockVariables, recipe: Recipe, p_device: int) -> int:
        """Do a command; return its status."""
        selected = int(screen.number("Recipe.List.SelectedIndex"))
        p_file = screen.element_address("Recipe.List.Names", selected)
        match edge:
            case "Recipe.Load":
                found = recipe.load(p_device, p_file, "")
                return found if isinstance(found, int) else 0
            case "Recipe.Save":
                return recipe.save(p_device, p_file, "", {})
            case "New.Create":
                return recipe.save(p_device, screen.place("New.FileName"), "", {})
            case "Recipe.Refresh":
                return 0
            case _:
                try:
                    self.context.library(Volumes).path(p_device, p_file).unlink()
                except (OSError, FileRefusedError):
                    return NOT_DELETED
                return 0

    def _files(self, p_device: int) -> list[str]:
        """Return the names of the files of a device."""
        try:
            folder: Path = self.context.library(Volumes).path(p_device, 0, is_optional=True)
            return sorted(each.name for each in folder.iterdir() if each.is_file())
        except (OSError, FileRefusedError):
            return []

    @staticmethod
    def _list(screen: BlockVariables, names: list[str]) -> None:
        room = screen.count_of("Recipe.List.Names")
        for index in range(room):
            screen.set_element(
                "Recipe.List.Names", index, names[index] if index < len(names) else ""
            )
        screen.set(Recipe__List__MaxSelection=max(min(len(names), room) - 1, 0))


BLOCKS: Final[Mapping[str, type[MappBlock]]] = {
    "MpRecipeRegPar": RegisterVariable,
    "MpRecipeRegParSync": RegisterVariable,
    "MpRecipeXml": RecipeFile,
    "MpRecipeCsv": CsvFile,
    "MpRecipeUI": RecipeUI,
}
"""What runs the blocks by their names."""
