"""What a variable has refused, told in the words of its declaration.

ctypes stores elementary values, and says no more than "'str' object cannot be interpreted as an
integer" where one is of the wrong kind. Which variable it was, and of which type, is found out when
it has happened, so that a store that is right costs nothing.
"""

from __future__ import annotations

import ast
import dis
import linecache
import re
from itertools import islice
from typing import TYPE_CHECKING, Any

from st_types import Array, Struct
from st_types.types.derived import ArrayType, StructType, resolve_alias
from st_types.types.views import type_of

if TYPE_CHECKING:
    from types import FrameType, TracebackType

    from st_types.types.elementary import DataType

_STORES = frozenset(["STORE_ATTR", "STORE_SUBSCR"])
_GIVEN = re.compile(r"'(\w+)' object|(?:not|type) (\w+)")


def refused_store(error: BaseException) -> str:
    """Return which variable could not take what, "" for anything else."""
    trace = error.__traceback__
    if not isinstance(error, TypeError) or trace is None:
        return ""
    while trace.tb_next is not None:
        trace = trace.tb_next
    target = _target(trace)
    data_type = None if target is None else _type_of(target, trace.tb_frame)
    given = _GIVEN.search(str(error))
    if target is None or data_type is None or given is None:
        return ""
    return f"{ast.unparse(target)} is {data_type} and cannot be a {given[1] or given[2]}"


def _target(trace: TracebackType) -> ast.expr | None:
    """Return what was to be stored to when something was raised."""
    code = trace.tb_frame.f_code
    if dis.opname[code.co_code[trace.tb_lasti]] not in _STORES:
        return None
    line, last, start, end = next(islice(code.co_positions(), trace.tb_lasti // 2, None))
    if line is None or line != last:
        return None
    source = linecache.getline(code.co_filename, line, trace.tb_frame.f_globals).encode()
    try:
        return ast.parse(source[start:end].decode(), mode="eval").body
    except (SyntaxError, ValueError):  # the file is another one by now
        return None


def _type_of(node: ast.expr, frame: FrameType) -> DataType[Any] | None:
    """Return the type of the variable that an expression names, None where it names none."""
    match node:
        case ast.Name(id=name):
            view = frame.f_locals.get(name)
            return type_of(view) if isinstance(view, Struct | Array) else None
        case ast.Attribute(value=inner, attr=name):
            data_type = _type_of(inner, frame)
            if isinstance(data_type, StructType) and data_type.spelling(name) == name:
                return resolve_alias(data_type.find(name)[0].data_type)
        case ast.Subscript(value=inner):
            data_type = _type_of(inner, frame)
            if isinstance(data_type, ArrayType):
                return resolve_alias(data_type.element)
    return None
