"""The Python face of a library: classes and constants that follow from its declarations.

A body in Python is a subclass of the face of its block::

    from plcsim.library.standard import interface

    class R_TRIG(interface.R_TRIG):
        def execute(self) -> None: ...

The members come from the ``.fun``. A file ``interface.py`` in the library's folder, written by
``plcsim types library``, tells them to editors and type checkers too; where there is none, the
module is made when it is imported.
"""

from __future__ import annotations

import contextlib
from enum import IntEnum
from types import ModuleType
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.errors import ConfigurationError
from plcsim.core.function_block import FunctionBlock
from plcsim.core.suggestion import did_you_mean
from plcsim.library.installed import installed
from st_types.types.derived import DataBlockType, EnumerationType, StructType
from st_types.types.elementary import DataType
from st_types.types.views import Struct

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.library.library import Library
    from st_types.resolve.scope import Scope

INTERFACE: Final = "interface"
"""The module of a library's package that holds the face."""

_BY_PACKAGE: dict[str, Library] = {}
"""Libraries of projects, while they are loaded."""


def register(library: Library) -> None:
    """Let the modules in a library's folder find its declarations."""
    _BY_PACKAGE[library.package] = library


def forget(package: str) -> None:
    """Forget the libraries whose package is this one, or lies in it."""
    for name in [*_BY_PACKAGE]:
        if name == package or name.startswith(f"{package}."):
            del _BY_PACKAGE[name]


class Declared:
    """The types that a library declares, for its ``interface.py``."""

    def __init__(self, library: Library) -> None:
        self.library = library

    def __getitem__(self, name: str) -> StructType[Any]:
        """Return a STRUCT or a data block.

        Raises:
            ConfigurationError: the library declares no such type, or it has no layout.
        """
        found = find_type(self.library.scope, name)
        if not isinstance(found, StructType):
            raise self._stale(name)
        return found

    def enumeration(self, members: type[IntEnum]) -> None:
        """Let variables of an enumeration read back as ``members``.

        Raises:
            ConfigurationError: the declaration has other values.
        """
        found = find_type(self.library.scope, members.__name__)
        if not isinstance(found, EnumerationType) or found.values != {
            m.name: m.value for m in members
        }:
            raise self._stale(members.__name__)
        found.members = members

    def _stale(self, name: str) -> ConfigurationError:
        file = self.library.folder / f"{INTERFACE}.py"
        return ConfigurationError(
            f"{file}: {name} is not as {self.library.name} declares it; "
            f"write the file anew: plcsim types library {self.library.folder}"
        )


def declared_beside(module: str) -> Declared:
    """Return the types of the library in whose folder a module lies.

    Args:
        module: its ``__name__``.
    """
    return Declared(library_of(module.rpartition(".")[0]))


def library_of(package: str) -> Library:
    """Return the library with this package.

    Raises:
        ConfigurationError: there is none.
    """
    found = _BY_PACKAGE.get(package) or installed().get(package)
    if found is None:
        raise ConfigurationError(f"{package}: is not the folder of a library")
    return found


class InterfaceModule(ModuleType):
    """The module ``interface`` of a library that has no such file; makes a face when asked."""

    def __init__(self, library: Library) -> None:
        super().__init__(f"{library.package}.{INTERFACE}")
        self._library = library

    def __getattr__(self, name: str) -> object:
        found = face_of(self._library.scope, name, self.__name__)
        setattr(self, name, found)
        return found

    def __dir__(self) -> list[str]:
        return names_of(self._library.scope)


def find_type(scope: Scope, name: str) -> object:
    """Return a type or a data block that a scope itself declares, None if there is none."""
    return scope.find_type(name) if name in scope.index.names("types") else None


def face_of(scope: Scope, name: str, module: str) -> object:
    """Return what Python sees of a declaration: a class, an enumeration, the value of a constant.

    Args:
        scope: that declares it itself.
        name: as declared.
        module: that the class belongs to.

    Raises:
        AttributeError: the scope declares no such thing, or it has no Python form.
    """
    found = find_type(scope, name)
    if isinstance(found, StructType):
        if found.view is None:
            base = FunctionBlock if isinstance(found, DataBlockType) else Struct
            type(name, (base,), {"_plc_type": found, "__module__": module})
        return found.view
    if isinstance(found, EnumerationType):
        return give_members(found) or found
    if isinstance(found, DataType):
        return found
    constants = {v.name: v.initial for v in scope.variables if v.is_constant}
    if constants.get(name) is None:
        near = did_you_mean(name, names_of(scope))
        raise AttributeError(f"{scope.name} declares no {name}{near}", name=name, obj=None)
    return constants[name]


def give_members(data_type: EnumerationType[Any]) -> type[IntEnum] | None:
    """Let variables of an enumeration read back as members of an IntEnum, which is returned.

    None where Python cannot have its names.
    """
    if data_type.members is None:
        with contextlib.suppress(ValueError, TypeError):
            data_type.members = _int_enum(data_type.name, data_type.values)
    return data_type.members


def _int_enum(name: str, values: Mapping[str, int]) -> type[IntEnum]:
    made: type[IntEnum] = IntEnum(name, dict(values))  # type: ignore[misc]  # made at run time
    return made


def names_of(scope: Scope) -> list[str]:
    """Return the names of all that a scope declares, but for variables."""
    index = scope.index
    constants = (entry.name for entry in index.variables if entry.is_constant)
    return [*index.names("types"), *index.names("functions"), *constants]
