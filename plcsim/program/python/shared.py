"""Names that a program in Python has beyond its own variables: global variables, constants."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar, overload

from st_types import Array, Struct
from st_types.types.derived import Member, StructType
from st_types.types.views import context_of, refused, type_of, view_class

if TYPE_CHECKING:
    from st_types.types.elementary import DataType

S = TypeVar("S", bound=Struct)
V = TypeVar("V")


class GlobalVariable:
    """A global variable as an attribute of a program.

    Args:
        name: of the variable.
        data_type: that the program expects, None for any.
    """

    def __init__(self, name: str, data_type: DataType[Any] | None = None) -> None:
        self.name = name
        self.data_type = data_type

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, view: Any, owner: type | None = None) -> Any:
        return self if view is None else getattr(context_of(view).globals, self.name)

    def __set__(self, view: Struct, value: object) -> None:
        variables = context_of(view).globals
        try:
            setattr(variables, self.name, value)
        except TypeError:
            raise refused(variables, self.name, value) from None


@overload
def var_external(data_type: type[S]) -> S: ...
@overload
def var_external(data_type: DataType[V]) -> V: ...
def var_external(data_type: Any) -> Any:
    """Declare that a program uses a global variable or constant of its project (VAR_EXTERNAL).

    A program has all of them by name; this tells the type to editors and type checkers,
    and the loader compares it with the declaration.

    Args:
        data_type: as in the declaration of the variable.
    """
    return GlobalVariable("", type_of(data_type))


class ConstantAttribute:
    """A CONSTANT as an attribute of a program.

    A STRUCT or an ARRAY is a copy each time, so that nothing can change the constant.

    Args:
        name: of the constant.
        data_type: its type.
        value: as declared; None for that of the type.
    """

    def __init__(self, name: str, data_type: DataType[Any], value: object) -> None:
        self.data_type = data_type
        self._name = name
        self._holder = view_class(StructType("CONSTANT", [Member(name, data_type, value)]))
        self._value = getattr(self._holder(), name)
        self._is_copied = isinstance(self._value, Struct | Array)

    def __get__(self, view: Any, owner: type | None = None) -> Any:
        if view is None:
            return self
        return getattr(self._holder(), self._name) if self._is_copied else self._value

    def __set__(self, view: Struct, value: object) -> None:
        raise AttributeError(f"{self._name} is CONSTANT")
