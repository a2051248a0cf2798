"""The structures beside a client: headers of requests and responses, and its statistics."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.library.astime.structures import NS_PER_SECOND
from plcsim.library.members import BlockVariables, StructMembers
from st_types.types.derived import StructType

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.core.context import Context
    from plcsim.library.http.messages import Response
    from plcsim.library.members import FindType

_OWN: Final = frozenset(["host", "content-type", "content-length", "connection", "keep-alive"])
"""Fields that have a member of their own, by their names in lower case."""

LONGEST_RAW: Final = 0x1_0000
"""Bytes of a raw header that count."""


class Headers:
    """The headers and statistics of the clients of a controller.

    Args:
        context: of the controller.
        find_type: finds the types of the library.
    """

    def __init__(self, context: Context, find_type: FindType) -> None:
        self._context = context
        self._memory = context.memory
        self._types = {
            name: StructMembers(found) if isinstance(found, StructType) else None
            for name in (
                "httpRequestHeader_t",
                "httpResponseHeader_t",
                "httpHeaderLine_t",
                "httpStatistics_t",
            )
            for found in (find_type(name),)
        }

    def fields_of_request(
        self, address: int, host: str, size: int
    ) -> tuple[list[tuple[str, str]], bytes]:
        """Return the fields of a request, and its raw lines.

        Args:
            address: of a httpRequestHeader_t, 0 for none.
            host: that it goes to.
            size: of its body, bytes.

        Raises:
            PageFault: the address is wild, or that of the raw lines.
        """
        fields = [("Host", host), ("Content-Length", str(size)), ("Connection", "close")]
        header = self._at(address, "httpRequestHeader_t")
        if header is None:
            return fields, b""
        if header.own_text("host"):
            fields[0] = ("Host", header.own_text("host"))
        if header.own_text("contentType"):
            fields.append(("Content-Type", header.own_text("contentType")))
        for line in self._lines(header):
            name = line.own_text("name")
            if name and name.lower() not in _OWN:
                fields.append((name, line.own_text("value")))
        return fields, self._raw_lines(header)

    def _raw_lines(self, header: BlockVariables) -> bytes:
        address = header.address("rawHeader.pData")
        size = min(int(header.number("rawHeader.dataLen")), LONGEST_RAW)
        raw = self._memory.read(address, size) if address else b""
        raw = raw.partition(b"\0")[0].rstrip(b"\r\n")
        return raw and raw + b"\r\n"

    def show_response(self, address: int, response: Response) -> None:
        """Write the header of a response to a httpResponseHeader_t, where there is one.

        Lines of users whose names are set get the values of these fields.

        Raises:
            PageFault: the address is wild, or that of the raw lines.
        """
        header = self._at(address, "httpResponseHeader_t")
        if header is None:
            return
        fields = response.fields
        header.set(
            protocol=response.protocol,
            status=f"{response.code} {response.reason}",
            contentType=fields.get("content-type", ""),
            contentLength=len(response.body),
            connection=fields.get("connection", ""),
            keepAlive=fields.get("keep-alive", ""),
        )
        for line in self._lines(header):
            if line.own_text("name"):
                line.set(value=fields.get(line.own_text("name").lower(), ""))
        raw = response.header[: max(int(header.number("rawHeader.dataSize")) - 1, 0)]
        if header.address("rawHeader.pData") and raw:
            self._memory.write(header.address("rawHeader.pData"), raw + b"\0")
            header.set(rawHeader__dataLen=len(raw))

    def count(self, address: int, name: str, error: int = 0) -> None:
        """Count in a httpStatistics_t, where there is one.

        Args:
            address: of it, 0 for none.
            name: what is counted: ``request``, ``response`` or ``error``.
            error: number of the error.

        Raises:
            PageFault: the address is wild.
        """
        statistics = self._at(address, "httpStatistics_t")
        if statistics is None:
            return
        counter = f"{name}Counter"
        statistics.set(**{counter: int(statistics.number(counter) + 1) & 0xFFFF_FFFF})
        if error:
            statistics.set(lastError=error)
        else:
            date = self._context.date_ns // NS_PER_SECOND
            statistics.set(**{f"timeOfLast{name.capitalize()}": date})

    def _at(self, address: int, name: str) -> BlockVariables | None:
        members = self._types[name]
        return BlockVariables(self._memory, members, address) if address and members else None

    def _lines(self, header: BlockVariables) -> Iterator[BlockVariables]:
        members = self._types["httpHeaderLine_t"]
        if members is None:
            return
        for index in range(header.count_of("userLine")):
            yield BlockVariables(self._memory, members, header.element_address("userLine", index))
