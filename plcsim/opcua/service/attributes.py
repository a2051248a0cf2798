"""The attribute service: reads from a snapshot, writes through the scan."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any, Final

from asyncua import ua
from asyncua.crypto.permission_rules import User, UserRole
from asyncua.server.address_space import AttributeService

from plcsim.opcua.service.values import MismatchError
from plcsim.shared_image import CommandOutcome, CommandRefused, ImageError, StoreCommand, Write

if TYPE_CHECKING:
    from collections.abc import Callable

    from asyncua.server.address_space import AddressSpace

    from plcsim.opcua.service.readings import Readings
    from plcsim.opcua.service.values import VariableCodec
    from plcsim.shared_image import Answer, ImageReader

_CODES: Final = ua.StatusCodes
_VALUE: Final = ua.AttributeIds.Value

_REFUSALS: Final = {
    CommandOutcome.CONSTANT: _CODES.BadNotWritable,
    CommandOutcome.OVERLAPS: _CODES.BadNotWritable,
    CommandOutcome.NO_SUCH_ADDRESS: _CODES.BadNodeIdInvalid,
}


class Attributes(AttributeService):
    """Answers Read and Write of the controller's variables; the rest is asyncua's.

    Args:
        space: asyncua's.
        readings: where values come from.
        image: where commands go.
        timeout_s: a write that the scan has not shown by then is answered BadTimeout; it may
            still come.
        applied: told of every write that the scan has applied: user, variable, bytes, and those
            that were there before.
        refused: told of every write that was not: user, node, status code.
    """

    def __init__(
        self,
        space: AddressSpace,
        readings: Readings,
        image: ImageReader,
        timeout_s: float,
        applied: Callable[[User, VariableCodec, bytes, bytes], None],
        refused: Callable[[User, str, str], None],
    ) -> None:
        super().__init__(space)
        self._readings = readings
        self._image = image
        self._timeout_s = timeout_s
        self._applied = applied
        self._refused = refused
        self._waiting: dict[int, asyncio.Future[Answer]] = {}

    def read(self, params: ua.ReadParameters) -> list[ua.DataValue]:
        """Return attributes; values are of one cycle."""
        asked = params.NodesToRead
        values = self._readings.read([r.NodeId for r in asked if r.AttributeId == _VALUE])
        results = []
        for each in asked:
            value = values.get(each.NodeId) if each.AttributeId == _VALUE else None
            if value is None:
                value = self._aspace.read_attribute_value(each.NodeId, each.AttributeId)
            elif each.IndexRange:
                value = _part(value, each.IndexRange)
            results.append(value)
        return results

    async def write(
        self, params: ua.WriteParameters, user: User | None = None
    ) -> list[ua.StatusCode]:
        """Write values, in the order in which they are given; acknowledged when a cycle has them.

        Nothing but values of the controller's variables can be written; asyncua itself, which
        comes as its administrator, keeps the nodes that tell of the server.
        """
        if user is None or user.role is UserRole.Admin:
            return await super().write(params)
        given = [self._begin(each, user) for each in params.NodesToWrite]
        codes = await asyncio.gather(*given)
        for each, code in zip(params.NodesToWrite, codes, strict=True):
            if code != _CODES.Good:
                name = ua.StatusCode(code).name
                self._refused(user, str(each.NodeId.Identifier), name)
        return [ua.StatusCode(code) for code in codes]

    async def _begin(self, each: ua.WriteValue, user: User) -> int:
        codec = self._readings.codecs.get(each.NodeId)
        if codec is None or each.AttributeId != _VALUE:
            known = each.NodeId in self._aspace
            return _CODES.BadUserAccessDenied if known else _CODES.BadNodeIdUnknown
        if not codec.leaf.is_writable:
            return _CODES.BadNotWritable
        if not getattr(user, "may_write", False):
            return _CODES.BadUserAccessDenied
        if each.IndexRange or each.Value.Value is None:
            return _CODES.BadWriteNotSupported
        if not _is_good(each.Value):  # no variable of the controller has a quality of its own
            return _CODES.BadWriteNotSupported
        try:
            data = codec.data(each.Value.Value)
        except MismatchError as err:
            return err.code
        return await self._send(codec, data, user)

    async def _send(self, codec: VariableCodec, data: bytes, user: User) -> int:
        try:
            ticket = self._image.send(Write([StoreCommand(codec.leaf.tag.address, data)]))
        except CommandRefused:
            return _CODES.BadTooManyOperations
        except ImageError:
            return _CODES.BadNoCommunication
        future = asyncio.get_running_loop().create_future()
        self._waiting[ticket] = future
        try:
            answer = await asyncio.wait_for(asyncio.shield(future), self._timeout_s)
        except TimeoutError:
            future.add_done_callback(lambda done: self._note(codec, data, user, done.result()))
            return _CODES.BadTimeout
        return self._note(codec, data, user, answer)

    def _note(self, codec: VariableCodec, data: bytes, user: User, answer: Answer) -> int:
        """Tell what has become of a write; return the status code."""
        if answer.outcome is not CommandOutcome.APPLIED:
            return _REFUSALS.get(answer.outcome, _CODES.BadInternalError)
        before = answer.before
        assert isinstance(before, Write)
        (store,) = before.operations
        assert isinstance(store, StoreCommand)
        self._applied(user, codec, data, store.data)
        return _CODES.Good

    def collect(self) -> None:
        """Look which writes the scan has answered; call it when it says so, and now and then."""
        for ticket, future in list(self._waiting.items()):
            answer = self._image.take_answer(ticket)
            if answer is not None:
                del self._waiting[ticket]
                future.set_result(answer)


def _is_good(value: ua.DataValue) -> bool:
    return value.StatusCode is None or value.StatusCode.value == _CODES.Good


def _part(value: ua.DataValue, text: str) -> ua.DataValue:
    """Return elements of an array of one dimension, ``"3"`` or ``"2:5"`` (OPC 10000-4, 7.22)."""
    variant: Any = value.Value
    low, colon, high = text.partition(":")
    if not low.isdigit() or (colon and not (high.isdigit() and int(low) < int(high))):
        return ua.DataValue(StatusCode=ua.StatusCode(_CODES.BadIndexRangeInvalid))
    if not variant.is_array or variant.Dimensions is None or len(variant.Dimensions) != 1:
        return ua.DataValue(StatusCode=ua.StatusCode(_CODES.BadIndexRangeNoData))
    found = variant.Value[int(low) : int(high or low) + 1]
    if not found:
        return ua.DataValue(StatusCode=ua.StatusCode(_CODES.BadIndexRangeNoData))
    return ua.DataValue(
        Value=ua.Variant(found, variant.VariantType, is_array=True),
        StatusCode=value.StatusCode,
        SourceTimestamp=value.SourceTimestamp,
        ServerTimestamp=value.ServerTimestamp,
    )
