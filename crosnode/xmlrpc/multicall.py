"""``system.multicall``: many calls in one, which rospy uses to unregister.

The parameter is one list of structs ``{methodName, params}``. The value is a list with, for each
call, either a list of its one value or a fault struct ``{faultCode, faultString}``.
Source: the proposal by Eric Kidd that all XML-RPC libraries follow.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from crosnode.xmlrpc.values import MethodCall, MethodFault, MethodResponse, Value

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

MULTICALL: Final = "system.multicall"
MAX_CALLS: Final = 1_000

MAX_VALUES: Final = 20_000
"""Values in all answers together: a short document could ask for any number of long ones."""

REPLY_TOO_LARGE: Final = -32500
INVALID_PARAMETERS: Final = -32602
"""Fault codes, as in xmlrpc-epi's fault code interoperability."""

TOO_LARGE: Final = MethodFault(
    REPLY_TOO_LARGE, f"the answers before have more than {MAX_VALUES} values"
)


def split_multicall(params: list[Value]) -> list[MethodCall | MethodFault]:
    """Return the calls in one call's parameters, with a fault in the place of each that is none."""
    if len(params) != 1 or not isinstance(params[0], list):
        return [MethodFault(INVALID_PARAMETERS, f"{MULTICALL} takes one list of structs")]
    if len(params[0]) > MAX_CALLS:
        return [MethodFault(INVALID_PARAMETERS, f"{MULTICALL} takes at most {MAX_CALLS} calls")]
    return [_call(entry) for entry in params[0]]


def _call(entry: Value) -> MethodCall | MethodFault:
    method = entry.get("methodName") if isinstance(entry, dict) else None
    params = entry.get("params", []) if isinstance(entry, dict) else None
    if not isinstance(method, str) or not isinstance(params, list):
        return MethodFault(INVALID_PARAMETERS, "expected a struct of methodName and params")
    if method == MULTICALL:
        return MethodFault(INVALID_PARAMETERS, f"{MULTICALL} within {MULTICALL}")
    return MethodCall(method, params)


def run_multicall(
    params: list[Value], answer: Callable[[MethodCall], MethodResponse | MethodFault]
) -> Iterator[Value]:
    """Answer calls in order, each when its turn in the value of the whole comes.

    Behind ``MAX_VALUES`` calls are not made; a fault stands for each.
    """
    left = MAX_VALUES
    for call in split_multicall(params):
        if isinstance(call, MethodCall) and left > 0:
            packed = _packed(answer(call))
        else:
            packed = _packed(call if isinstance(call, MethodFault) else TOO_LARGE)
        left -= _count(packed)
        yield packed


def _count(value: Value) -> int:
    """Return how many values a value is made of."""
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return 1 + sum(map(_count, inner))


def _packed(reply: MethodResponse | MethodFault) -> Value:
    if isinstance(reply, MethodFault):
        return {"faultCode": reply.code, "faultString": reply.text}
    return [reply.value]
