"""httpClient: one request at a time over the controller's network, on a connection of its own.

What no document says is ours: the connection ends with the response, whatever the headers ask for;
names of hosts are not resolved, but for ``localhost``; an exchange that takes 30 s has failed.
There is no TLS: a request of httpsClient fails.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.library.http import statuses
from plcsim.library.http.headers import Headers
from plcsim.library.http.messages import (
    LONGEST_HEADER,
    MalformedError,
    parse_response,
    request_bytes,
)
from plcsim.library.members import changes, rises
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_OK
from plcsim.library.status_block import StatusBlock
from plcsim.network.protocol import (
    ANY_IP,
    ANY_IPV6,
    MAX_RECEIVE,
    Address,
    Outcome,
    is_connectable,
    network_of,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.http.messages import Response
    from plcsim.library.members import BlockVariables, FindType
    from plcsim.network.protocol import Socket
    from st_types.types.derived import StructType

LIMIT_NS: Final = 30_000_000_000
"""Longest time of an exchange, from the request to the response."""

LONGEST_URI: Final = 0x1_0000
"""Characters of a URI that count."""

_EDGES: Final = ("send", "abort")

LOCAL_HOST: Final = ("localhost", "127.0.0.1")

_GOES_ON: Final = frozenset([Outcome.WOULD_BLOCK, Outcome.NO_RESOURCES])


class _Exchange:
    """A request that is under way, or how the last one ended.

    Attributes:
        socket: None where none is under way.
        server: it goes to.
        unsent: bytes of the request that have not gone.
        received: bytes of the response.
        began_ns: release in which it began.
        status: of it.
        phase: of it.
    """

    def __init__(self) -> None:
        self.socket: Socket | None = None
        self.server = Address("", 0)
        self.unsent = b""
        self.received = b""
        self.began_ns = 0
        self.status = ERR_OK
        self.phase = statuses.NOT_CONNECTED

    def begin(self, socket: Socket, server: Address, request: bytes, now_ns: int) -> None:
        """Have a request that is under way."""
        self.socket, self.server, self.unsent, self.received = socket, server, request, b""
        self.began_ns, self.status, self.phase = now_ns, ERR_FUB_BUSY, statuses.NOT_CONNECTED

    def end(self, status: int, phase: int = statuses.NOT_CONNECTED) -> None:
        """End it, and close its connection."""
        if self.socket is not None:
            self.socket.close()
        self.socket, self.unsent, self.received = None, b"", b""
        self.status, self.phase = status, phase

    def send(self) -> int:
        """Connect and send as far as it goes now; return why that fails."""
        assert self.socket is not None
        if self.phase == statuses.NOT_CONNECTED:
            outcome = self.socket.connect(self.server)
            if outcome is not Outcome.OK:
                is_waiting = outcome is Outcome.WOULD_BLOCK
                return ERR_FUB_BUSY if is_waiting else statuses.CLIENT_TCP_CONN_FAILED
            self.phase = statuses.SENDING
        if self.unsent:
            outcome, taken = self.socket.send(self.unsent)
            self.unsent = self.unsent[taken:]
            if outcome is not Outcome.OK and outcome not in _GOES_ON:
                return statuses.CLIENT_TCP_DISCONNECTED
        if not self.unsent:
            self.phase = statuses.RECEIVING
        return ERR_FUB_BUSY

    def receive(self, room: int) -> Response | int:
        """Receive what is there; return the response, or BUSY, or why there is none.

        Args:
            room: for its body, bytes.
        """
        assert self.socket is not None
        outcome, data = self.socket.recv(MAX_RECEIVE)
        self.received += data
        if outcome in _GOES_ON:
            return ERR_FUB_BUSY
        if outcome not in (Outcome.OK, Outcome.CLOSED):
            return statuses.CLIENT_TCP_DISCONNECTED
        try:
            found = parse_response(self.received, is_ended=outcome is Outcome.CLOSED)
        except MalformedError:
            return statuses.CLIENT_TCP_DISCONNECTED
        if found is None and len(self.received) > room + LONGEST_HEADER:
            return statuses.DATA_SIZE
        return ERR_FUB_BUSY if found is None else found


class _Exchanges:
    """The exchanges of the blocks of a controller, by address; a restart ends them."""

    def __init__(self, _context: Context) -> None:
        self.by_block: dict[int, _Exchange] = {}

    def close(self) -> None:
        """End all."""
        for each in self.by_block.values():
            each.end(ERR_OK)


class HttpClient(StatusBlock):
    """httpClient: a rising edge of send begins a request, one of abort ends it.

    Statuses: ERR_FUB_BUSY while one is under way; ERR_OK before the first, and with the phase
    RECEIVED after a response; else that of a request that failed, until the next.
    """

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._headers = Headers(context, find_type)

    def step(self, variables: BlockVariables) -> int:
        """Take an edge, then go on as far as it goes now."""
        exchanges = self.context.library(_Exchanges).by_block
        exchange = exchanges.setdefault(variables.start, _Exchange())
        edges = [rises(self.context, variables.start, variables, name) for name in _EDGES]
        is_sent, is_aborted = edges
        if is_aborted:
            exchange.end(ERR_OK)
        elif is_sent and exchange.socket is None:
            variables.set(httpStatus=0, responseDataLen=0)
            self._settle(variables, exchange, self.begin(variables, exchange))
        if exchange.socket is not None:
            self._go_on(variables, exchange)
        variables.set(phase=exchange.phase)
        return exchange.status

    def rest(self, variables: BlockVariables) -> None:
        """End the exchange."""
        exchange = self.context.library(_Exchanges).by_block.pop(variables.start, None)
        if exchange is not None:
            exchange.end(ERR_OK)
        for name in _EDGES:
            changes(self.context, variables.start, name, 0)
        variables.set(phase=statuses.NOT_CONNECTED)

    def begin(self, variables: BlockVariables, exchange: _Exchange) -> int:
        """Begin an exchange; return BUSY, or why there is none."""
        method = statuses.METHODS.get(int(variables.number("method")))
        if not (variables.address("pHost") and variables.address("pUri")):
            return statuses.INVALID_PARAM
        if method is None:
            return statuses.METHOD_UNSUPPORTED
        host = variables.text("pHost")
        ip = LOCAL_HOST[1] if host == LOCAL_HOST[0] else host
        server = Address(ip, int(variables.number("hostPort")))
        if not is_connectable(server):
            return statuses.CLIENT_TCP_INVALID_HOST
        own_ip = ANY_IPV6 if ":" in ip else ANY_IP
        _, socket = network_of(self.context).open(own_ip, 0)
        if socket is None:
            return statuses.CLIENT_ERR_SOCKET_CREATE
        request = self._request(variables, method, host)
        exchange.begin(socket, server, request, self.context.release_ns)
        self._headers.count(variables.address("pStatistics"), "request")
        return ERR_FUB_BUSY

    def _request(self, variables: BlockVariables, method: str, host: str) -> bytes:
        address, memory = variables.address("pRequestData"), self.context.memory
        size = int(variables.number("requestDataLen"))
        body = memory.read(address, size) if address else b""
        is_newer = int(variables.number("option")) & statuses.OPTION_HTTP_11
        uri = variables.text("pUri", LONGEST_URI).replace(" ", "%20") or "/"
        fields, raw = self._headers.fields_of_request(
            variables.address("pRequestHeader"), host, len(body)
        )
        return request_bytes(f"{method} {uri} HTTP/1.{int(bool(is_newer))}", fields, raw, body)

    def _go_on(self, variables: BlockVariables, exchange: _Exchange) -> None:
        """Send and receive."""
        found: Response | int = exchange.send()
        if found == ERR_FUB_BUSY and exchange.phase == statuses.RECEIVING:
            found = exchange.receive(int(variables.number("responseDataSize")))
        if not isinstance(found, int):
            found = self._show(variables, found)
        elif self.context.release_ns - exchange.began_ns > LIMIT_NS and found == ERR_FUB_BUSY:
            found = statuses.CLIENT_TCP_DISCONNECTED
        self._settle(variables, exchange, found)

    def _settle(self, variables: BlockVariables, exchange: _Exchange, status: int) -> None:
        """End the exchange, unless it is BUSY."""
        if status == ERR_FUB_BUSY:
            return
        if status == ERR_OK:
            exchange.end(ERR_OK, statuses.RECEIVED)
            self._headers.count(variables.address("pStatistics"), "response")
        else:
            exchange.end(status)
            self._headers.count(variables.address("pStatistics"), "error", status)

    def _show(self, variables: BlockVariables, response: Response) -> int:
        """Hand the response over; return the status."""
        variables.set(httpStatus=response.code)
        self._headers.show_response(variables.address("pResponseHeader"), response)
        room = int(variables.number("responseDataSize"))
        if len(response.body) > room:
            return statuses.DATA_SIZE
        address = variables.address("pResponseData")
        if address:
            self.context.memory.write(address, (response.body + b"\0")[:room])
            variables.set(responseDataLen=len(response.body))
        return ERR_OK


class HttpsClient(HttpClient):
    """httpsClient: there is no TLS."""

    def begin(self, _variables: BlockVariables, _exchange: _Exchange) -> int:
        """Say so."""
        return statuses.SSL_HANDSHAKE_FAILED


BLOCKS: Final[Mapping[str, type[StatusBlock]]] = {
    "httpClient": HttpClient,
    "httpsClient": HttpsClient,
}
"""What runs the blocks by their names."""
