"""Variables of a VAR block as they lie in PLC memory: one STRUCT, and one of the constants.

Constants lie apart, so that what must not be written is one range of addresses.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from plcsim.core.errors import ConfigurationError
from plcsim.core.tag import Tag
from st_types.errors import DeclarationError
from st_types.types.derived import Member, StructType
from st_types.types.values import initial_image

if TYPE_CHECKING:
    from collections.abc import Iterable

    from plcsim.core.memory import Memory
    from st_types.resolve.declared import DeclaredVariable


class DeclaredVariables(NamedTuple):
    """The variables of a program, or the global ones.

    Attributes:
        variables: those that may be written, in the order of declaration.
        constants: VAR CONSTANT.
    """

    variables: StructType[Any]
    constants: StructType[Any]

    def allocate(self, memory: Memory, path: str) -> tuple[Tag, Tag | None]:
        """Reserve memory for both and give them their initial values, as each boot does again.

        Args:
            memory: of the controller.
            path: of the tags; the name of a program, "" for the global ones.

        Returns:
            the variables, and the constants where there are some.

        Raises:
            ConfigurationError: the memory is full.
        """
        constants = None
        if self.constants.members:
            constants = _allocate(memory, path, self.constants)._replace(is_constant=True)
        return _allocate(memory, path, self.variables), constants


def _allocate(memory: Memory, path: str, data_type: StructType[Any]) -> Tag:
    address = memory.allocate(data_type.size, data_type.alignment)
    memory.write(address, initial_image(data_type))
    return Tag(path, data_type, address)


def variables_of(name: str, declared: Iterable[DeclaredVariable]) -> DeclaredVariables:
    """Return the variables that VAR blocks declare; what has no layout was told and is left out.

    Args:
        name: of the STRUCTs.
        declared: of one scope, names of their own.

    Raises:
        ConfigurationError: they are larger together than an address space.
    """
    members: dict[bool, list[Member]] = {True: [], False: []}
    for variable in declared:
        if variable.data_type is not None:
            member = Member(
                variable.name,
                variable.data_type,
                variable.initial,
                is_retained=variable.is_retained,
            )
            members[variable.is_constant].append(member)
    try:
        return DeclaredVariables(
            StructType(name, members[False]), StructType(f"{name} CONSTANT", members[True])
        )
    except DeclarationError as err:
        raise ConfigurationError(f"the variables of {err}") from None
