"""TcpipSocket: the socket of the thesis (section 1.2.2, appendix A) over the AsTCP blocks.

All that a node sends or receives goes through here. The blocks lie in PLC memory, as do the two
areas that TcpRecv writes to and TcpSend reads from; the areas are shared by all sockets of a
controller, for both blocks finish in the call (docs/decisions/0003-astcp-open-questions.md).
Nothing here waits: each method does what can be done now and says how far it came.
"""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.memory import adr
from plcsim.library.astcp import (
    ERR_FUB_BUSY,
    ERR_OK,
    TcpClient,
    TcpClose,
    TcpIoctl,
    TcpOpen,
    TcpRecv,
    TcpSend,
    TcpServer,
    tcpERR_NO_DATA,
    tcpERR_NOCLIENT,
    tcpERR_NOMORE_IDENTS,
    tcpERR_NOT_CONNECTED,
    tcpERR_SENTLEN,
    tcpERR_WOULDBLOCK,
    tcpINVALID_IDENT,
    tcpOPT_REUSEADDR,
    tcpSO_ADDRESS_GET,
    tcpSO_ADDRESS_typ,
    tcpSO_KEEPALIVE_SET,
    tcpTCP_KEEPCNT_SET,
    tcpTCP_KEEPIDLE_SET,
    tcpTCP_KEEPINTVL_SET,
    tcpTCP_NODELAY_SET,
)
from plcsim.library.astcp.idents import IdentTable
from plcsim.library.astcp.settings import AsTcpSettings
from plcsim.library.astcp.transfer import expect_stream, receive_outside, send_outside
from plcsim.network.protocol import ANY_IPV6, MAX_LITERAL
from st_types import STRING, UDINT, UINT, Struct, var

if TYPE_CHECKING:
    from crosnode.transport.dyn_buffer import DynBuffer
    from plcsim.core.context import Context

AREA_SIZE: Final = 65_536
"""Bytes of each transfer area, the most that one call of TcpRecv gives."""

LARGE_PIECE: Final = AREA_SIZE
"""Bytes; a piece of so many is written from where it is."""

SOCKETS_AT_START: Final = 32
"""Sockets whose blocks are laid out before the first cycle; more are made when needed."""


OPTIONS: Final = (
    (tcpTCP_NODELAY_SET, 1),
    (tcpTCP_KEEPIDLE_SET, 15),
    (tcpTCP_KEEPINTVL_SET, 5),
    (tcpTCP_KEEPCNT_SET, 3),
    (tcpSO_KEEPALIVE_SET, 1),
)
"""Of each connection. A peer whose host has gone without a word is noticed 30 s after its last one,
as it is by rospy after 150 s; without a word from us TCP itself would notice after two hours."""


class TcpipSocketState(IntEnum):
    """How far a call came; names and values of appendix A."""

    FAILED = 0
    IN_PROGRESS = 1
    DISCONNECTED = 2
    DONE = 3
    UNKNOWN = 4


_FAILED: Final = TcpipSocketState.FAILED
_IN_PROGRESS: Final = TcpipSocketState.IN_PROGRESS
_DISCONNECTED: Final = TcpipSocketState.DISCONNECTED
_DONE: Final = TcpipSocketState.DONE
_UNKNOWN: Final = TcpipSocketState.UNKNOWN

_NOTHING: Final = memoryview(b"")

_STATUS_RANGE: Final = range(32_600, 32_700)
"""AsTCP's own statuses; others are not expected from its blocks."""


class Transfer(NamedTuple):
    """How far a read or a write came, and the bytes moved."""

    state: TcpipSocketState
    size: int


class SocketBlocks(Struct):
    """What a socket has in PLC memory."""

    address = var(STRING(45))
    own_port = var(UINT)
    value = var(UDINT)
    where = var(tcpSO_ADDRESS_typ)
    open = var(TcpOpen)
    server = var(TcpServer)
    client = var(TcpClient)
    send = var(TcpSend)
    recv = var(TcpRecv)
    close = var(TcpClose)
    ioctl = var(TcpIoctl)


class SocketPool:
    """The sockets of one controller: PLC memory is never given back, so they are used again.

    Args:
        context: the controller's; ``context.library(SocketPool)`` gives its one pool.

    Attributes:
        idents: sockets that AsTCP has for all nodes and programs together.
        shortages: times that one was asked for and none was free.
        any_ipv6: address of the literal that stands for all interfaces of IPv6.
    """

    def __init__(self, context: Context) -> None:
        self.context = context
        self.idents = (context.settings(AsTcpSettings) or AsTcpSettings()).idents
        self.shortages = 0
        self.any_ipv6 = context.memory.allocate(len(ANY_IPV6) + 1)
        context.memory.write(self.any_ipv6, ANY_IPV6.encode() + b"\0")
        self.recv_area = context.memory.allocate(AREA_SIZE)
        self.send_area = context.memory.allocate(AREA_SIZE)
        self._free = [self._new() for _ in range(SOCKETS_AT_START)]

    def look(self) -> set[int]:
        """Return the idents with news: a client, bytes, or the end of a connection."""
        return self.context.library(IdentTable).look()

    def get(self) -> TcpipSocket:
        """Return a socket that is not open."""
        return self._free.pop() if self._free else self._new()

    def put(self, socket: TcpipSocket) -> None:
        """Close a socket and take it back."""
        socket.close()
        self._free.append(socket)

    def _new(self) -> TcpipSocket:
        return TcpipSocket(self)


class TcpipSocket:
    """A TCP socket. ``init``, then ``open``, then ``connect``, or ``listen`` and ``accept``.

    Args:
        pool: whose transfer areas it uses.

    Attributes:
        ident: of AsTCP, tcpINVALID_IDENT while it is not open.
        ip: address of the peer, or of the own interface where it listens.
        port: port of the peer, or the one to listen at.
        status: the status of the last block called, for messages.
    """

    __slots__ = (
        "_address",
        "_area",
        "_blocks",
        "_connected",
        "_memory",
        "_pool",
        "_recv",
        "_send",
        "_server",
        "ident",
        "ip",
        "port",
        "status",
    )

    def __init__(self, pool: SocketPool) -> None:
        self._pool = pool
        self._memory = pool.context.memory
        self._blocks = blocks = self._memory.new(SocketBlocks, pool.context)
        self._recv, self._send, self._server = blocks.recv, blocks.send, blocks.server
        self._address = adr(blocks, "address")
        blocks.recv.pData, blocks.recv.enable = pool.recv_area, True
        blocks.send.pData, blocks.send.enable = pool.send_area, True
        self._area = pool.send_area
        self.ident = tcpINVALID_IDENT
        self._connected = False
        self.ip, self.port, self.status = "", 0, ERR_OK

    def init(self, ip: str, port: int) -> None:
        """Name the peer, or for a listener the own interface; "" is every interface."""
        self.ip, self.port = ip, port
        self._blocks.address = ip[:MAX_LITERAL]

    def check_address_and_change_if_necessary(self, ip: str, port: int) -> None:
        """Name another peer; an open connection to the former one is closed."""
        if (ip, port) != (self.ip, self.port):
            self.close()
            self.init(ip, port)

    @property
    def is_open(self) -> bool:
        """Whether the socket has an ident."""
        return self.ident != tcpINVALID_IDENT

    @property
    def is_connected(self) -> bool:
        """Whether a connection was made and not seen to end."""
        return self._connected

    def open(self, *, listening: bool = False) -> TcpipSocketState:
        """Open the socket; to listen, it is bound to ``ip`` and ``port``.

        Returns:
            DONE, IN_PROGRESS (no ident is free now) or FAILED.
        """
        block = self._blocks.open
        block.pIfAddr = self._interface(listening=listening)
        block.port = self.port if listening else 0
        block.options = tcpOPT_REUSEADDR if listening else 0
        block(enable=True)
        self.status = block.status
        if block.status == ERR_OK:
            self._use(block.ident)
            return _DONE
        if block.status == tcpERR_NOMORE_IDENTS:
            self._pool.shortages += 1
            return _IN_PROGRESS
        return _state_of(block.status)

    def _interface(self, *, listening: bool) -> int:
        """Return the address of the STRING to bind to; a client of IPv6 needs a socket of it."""
        if listening:
            return self._address if self.ip else 0
        return self._pool.any_ipv6 if ":" in self.ip else 0

    def _use(self, ident: int) -> None:
        self.ident = ident
        self._recv.ident = self._send.ident = ident

    def connect(self) -> TcpipSocketState:
        """Open the socket where it is not yet, and go on connecting to ``ip`` and ``port``.

        Returns:
            DONE, IN_PROGRESS or FAILED.
        """
        if not self.is_open and (state := self.open()) is not _DONE:
            return state
        block = self._blocks.client
        block(enable=True, ident=self.ident, pServer=self._address,
              portserv=self.port)  # fmt: skip
        self.status = block.status
        self._connected = block.status == ERR_OK
        if block.status == ERR_FUB_BUSY:
            return _IN_PROGRESS
        return _DONE if self._connected else _FAILED

    def accept(self, client: TcpipSocket, backlog: int) -> TcpipSocketState:
        """Listen, and give the next connection to ``client``, which must not be open.

        Returns:
            DONE, IN_PROGRESS (nobody there, or no ident is free) or FAILED.
        """
        block = self._server
        block.enable, block.ident, block.backlog = True, self.ident, backlog
        block.pIpAddr = client._address
        block.execute()
        self.status = block.status
        if block.status == ERR_OK:
            client._use(block.identclnt)
            client.ip, client.port = client._blocks.address, block.portclnt
            client._connected = True
            return _DONE
        if block.status == tcpERR_NOMORE_IDENTS:
            self._pool.shortages += 1
            return _IN_PROGRESS
        return _IN_PROGRESS if block.status in (ERR_FUB_BUSY, tcpERR_NOCLIENT) else _FAILED

    def read_buffer(self, buffer: DynBuffer) -> TcpipSocketState:
        """Read what is there, at most what one call of TcpRecv gives; as ``read_buffer_ex``."""
        return self.read_buffer_ex(buffer, AREA_SIZE).state

    def read_buffer_ex(self, buffer: DynBuffer, max_size: int) -> Transfer:
        """Read up to ``max_size`` bytes to the end of a buffer.

        Returns:
            DONE with the bytes read, IN_PROGRESS (nothing there, or the buffer is full),
            DISCONNECTED (the peer closed or was lost) or FAILED.
        """
        state, data = self.read_area(min(max_size, buffer.maximum - buffer.size))
        buffer.push_back(bytes(data))
        return Transfer(state, len(data))

    def read_area(self, max_size: int) -> tuple[TcpipSocketState, memoryview]:
        """Read up to ``max_size`` bytes and leave them in the area of TcpRecv, without a copy.

        Returns:
            The state as of ``read_buffer_ex``, and a view of the bytes, which is good until any
            socket of the controller reads again.
        """
        if max_size <= 0:
            return _IN_PROGRESS, _NOTHING
        block = self._recv
        block.datamax = min(max_size, AREA_SIZE)
        block.execute()
        self.status = status = block.status
        if status == tcpERR_NO_DATA:
            return _IN_PROGRESS, _NOTHING
        if status == ERR_OK and (received := block.recvlen):
            return _DONE, self._memory.view(block.pData, received)
        return self._ended(status), _NOTHING

    def read_into(self, target: memoryview) -> Transfer:
        """Read what is there to a place of a large message, past the area of TcpRecv.

        Returns:
            The state as of ``read_buffer_ex``, and the bytes read.
        """
        status, size = receive_outside(self._pool.context, self.ident, target)
        self.status = status
        if status == tcpERR_NO_DATA:
            return Transfer(_IN_PROGRESS, 0)
        if status == ERR_OK and size:
            return Transfer(_DONE, size)
        return Transfer(self._ended(status), 0)

    def expect_stream(self, size: int) -> None:
        """Let the peer send up to ``size`` bytes between two reads, 1 at first.

        With more than 1 the socket is to be read in each step, whether it has news or not.
        """
        expect_stream(self._pool.context, self.ident, size)

    def write_buffer(self, buffer: DynBuffer) -> TcpipSocketState:
        """Write from the front of a buffer as much as is taken; as ``write_buffer_ex``."""
        return self.write_buffer_ex(buffer, buffer.size).state

    def write_buffer_ex(self, buffer: DynBuffer, max_size: int) -> Transfer:
        """Write up to ``max_size`` bytes from the front of a buffer; what is taken leaves it.

        Returns:
            DONE (the buffer is empty), IN_PROGRESS (it is not), DISCONNECTED or FAILED, with the
            bytes written.
        """
        written = 0
        while buffer.size and written < max_size:
            state, taken = self._write(buffer, max_size - written)
            written += taken
            if state is not _DONE:
                return Transfer(state, written)
        return Transfer(_IN_PROGRESS if buffer.size else _DONE, written)

    def _write(self, buffer: DynBuffer, size: int) -> Transfer:
        """Write small pieces by way of TcpSend's area, joined, and a large one from its place."""
        if buffer.front_size >= LARGE_PIECE:
            status, taken = send_outside(self._pool.context, self.ident, buffer.front(size))
        else:
            data = buffer.peek(min(size, AREA_SIZE))
            self._memory.write(self._area, data)
            block = self._send
            block.datalen = len(data)
            block.execute()
            status, taken = block.status, block.sentlen
        self.status = status
        if status in (ERR_OK, tcpERR_SENTLEN):
            buffer.discard(taken)
            return Transfer(_DONE if status == ERR_OK else _IN_PROGRESS, taken)
        if status == tcpERR_WOULDBLOCK:
            return Transfer(_IN_PROGRESS, 0)
        return Transfer(self._ended(status), 0)

    def _ended(self, status: int) -> TcpipSocketState:
        """Return the state for a status that is neither data nor waiting."""
        if status in (ERR_OK, tcpERR_NOT_CONNECTED):
            self._connected = False
            return _DISCONNECTED
        return _state_of(status)

    read_string = read_buffer
    """Read what is there to the end of a DynString."""

    write_string = write_buffer
    """Write a DynString from its front."""

    def set_option(self, place: int) -> None:
        """Set one of ``OPTIONS``."""
        option, self._blocks.value = OPTIONS[place]
        self._ioctl(option, adr(self._blocks, "value"), 4)

    @property
    def own_port(self) -> int:
        """The own port: ``tcpIpSocketGetPort`` of the thesis; 0 where the socket is not open."""
        blocks = self._blocks
        blocks.own_port = 0
        blocks.where.pPort, blocks.where.pIpAddr = adr(blocks, "own_port"), 0
        self._ioctl(tcpSO_ADDRESS_GET, adr(blocks, "where"), 8)
        return blocks.own_port

    def _ioctl(self, ioctl: int, data: int, size: int) -> None:
        block = self._blocks.ioctl
        block(enable=True, ident=self.ident, ioctl=ioctl, pData=data, datalen=size)

    def close(self) -> None:
        """Close the socket where it is open; what was written still goes out."""
        if self.is_open:
            self._blocks.close(enable=True, ident=self.ident)
            self._blocks.client(enable=False)
            self._blocks.server(enable=False)
        self._use(tcpINVALID_IDENT)
        self._connected = False


def _state_of(status: int) -> TcpipSocketState:
    if status == ERR_FUB_BUSY:
        return _IN_PROGRESS
    return _FAILED if status in _STATUS_RANGE else _UNKNOWN
