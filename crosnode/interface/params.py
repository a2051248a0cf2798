"""Parameters: those that are followed, and the blocks that ask for one and set one."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from crosnode.errors import MessageValueError
from crosnode.interface import interface
from crosnode.interface.handles import NodeHandle, RoleHandle, handles_of, put_text
from crosnode.interface.interface import (
    crosERR_CUT,
    crosERR_HANDLE,
    crosERR_NO_MASTER,
    crosERR_REFUSED,
    crosERR_VALUE,
)
from crosnode.node.parameter import ParameterSubscription
from crosnode.xmlrpc.api_caller import ApiCall, CallState
from plcsim.core.context import Context  # noqa: TC001  # the type of a parameter people look up
from plcsim.library.block import AsynchronousBlock
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_OK

if TYPE_CHECKING:
    from crosnode.interface.handles import Handles
    from crosnode.node import CrosNode
    from crosnode.xmlrpc import Value


def _param(context: Context, handle: int) -> ParameterSubscription | None:
    found = handles_of(context).find(RoleHandle, handle)
    return found.role if found and isinstance(found.role, ParameterSubscription) else None


def _value(context: Context, handle: int) -> Value:
    param = _param(context, handle)
    return param.value if param else None


@function("cRosParamInt")
def whole(context: Context, param: int) -> int:
    """Return a parameter as a whole number."""
    value = _value(context, param)
    return int(value) if isinstance(value, (int, float)) else 0


@function("cRosParamReal")
def real(context: Context, param: int) -> float:
    """Return a parameter as a number."""
    value = _value(context, param)
    return float(value) if isinstance(value, (int, float)) else 0.0


@function("cRosParamString")
def text(context: Context, param: int, address: int, size: int) -> int:
    """Write a parameter as a text to an address."""
    if _param(context, param) is None:
        return crosERR_HANDLE
    return (
        crosERR_CUT if put_text(context, address, size, _told(_value(context, param))) else ERR_OK
    )


@function("cRosParamChanged")
def has_changed(context: Context, param: int) -> bool:
    """Whether there is a change that was not told yet."""
    found = _param(context, param)
    return found is not None and found.pop() is not None


def _told(value: Value) -> str:
    """Return a value as a text: a text as it is, all else as JSON."""
    return value if isinstance(value, str) else json.dumps(value, default=str)


def parsed(text: str) -> Value:
    """Return what a text means: JSON where it is, else the text itself."""
    try:
        found: Value = json.loads(text)
    except ValueError:
        return text
    return text if found is None else found


class _ParamBlock(AsynchronousBlock):
    """Base of both blocks: one call to the master."""

    __slots__ = ()

    node: int
    i_call: int

    def _start(self, node: CrosNode) -> ApiCall:
        """Make the call."""
        raise NotImplementedError(f"{type(self).__name__} has no _start method.")

    def _take(self, call: ApiCall) -> int:
        """Take the answer; return the status."""
        return ERR_OK

    def step(self) -> int:
        """Start the call, or look whether it has its answer."""
        handles = handles_of(self.context)
        call = handles.find(ApiCall, self.i_call)
        if call is None:
            return self._begin(handles)
        if call.state is CallState.WAITING:
            return ERR_FUB_BUSY
        handles.release(self.i_call)
        self.i_call = 0
        if call.state is CallState.DONE:
            return self._take(call)
        return crosERR_REFUSED if call.was_answered else crosERR_NO_MASTER

    def _begin(self, handles: Handles) -> int:
        owner = handles.find(NodeHandle, self.node)
        if owner is None:
            return crosERR_HANDLE
        try:
            self.i_call = handles.add(self._start(owner.node))
        except MessageValueError:
            return crosERR_VALUE
        return ERR_FUB_BUSY


class cRosApiSetParam(interface.cRosApiSetParam, _ParamBlock):
    """Sets a parameter."""

    __slots__ = ()

    def _start(self, node: CrosNode) -> ApiCall:
        return node.set_param(self.key, parsed(self.value))


class cRosApiGetParam(interface.cRosApiGetParam, _ParamBlock):
    """Asks for a parameter."""

    __slots__ = ()

    def _start(self, node: CrosNode) -> ApiCall:
        return node.get_param(self.key)

    def _take(self, call: ApiCall) -> int:
        told = json.dumps(call.value, default=str)
        self.value = told
        return crosERR_CUT if self.value != told else ERR_OK
