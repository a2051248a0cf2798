"""Errors of crosnode.

::

    CrosnodeError                    base of all
    ├── MessageTypeError             a message, service or action type that cannot be had
    │   ├── UnknownTypeError         no definition found under this name (also a LookupError)
    │   └── DefinitionError          a definition that genmsg would not load, with its line
    ├── MessageValueError            ours: a value that its field cannot hold (also a ValueError)
    ├── InvalidNameError             ours: not a ROS graph name (also a ValueError)
    ├── HostPendingError             the address of a host is being asked for; try a later step
    ├── TransformError               no transform between two frames (also a LookupError)
    ├── NodeError                the world's: a node cannot start, for it gets no port
    ├── LocalProtocolError           ours: a protocol object used out of turn
    └── RemoteProtocolError          theirs: a peer broke a protocol; its connection ends
        ├── DecodeError              bytes that are not a message of the type
        ├── TcprosError              a TCPROS header or frame
        └── XmlRpcError              an HTTP or XML-RPC message
            └── LimitError           a message over one of our limits
"""


class CrosnodeError(Exception):
    """Base of all errors of this package."""


class MessageTypeError(CrosnodeError):
    """A message, service or action type cannot be had."""


class UnknownTypeError(MessageTypeError, LookupError):
    """No definition was found under this type name."""

    def __str__(self) -> str:
        return str(self.args[0])


class DefinitionError(MessageTypeError):
    """The text of a definition is wrong; the message names type and line."""


class MessageValueError(CrosnodeError, ValueError):
    """A value does not fit its field; the message names type and field."""


class InvalidNameError(CrosnodeError, ValueError):
    """A name is not a legal ROS graph name."""


class HostPendingError(CrosnodeError):
    """The address of a host is being asked for: a later step knows it, or that there is none."""


class NodeError(CrosnodeError):
    """A node or a master cannot start."""


class TransformError(CrosnodeError, LookupError):
    """There is no transform between two frames, or not at that time."""


class LocalProtocolError(CrosnodeError):
    """A protocol object was used out of turn by this program."""


class RemoteProtocolError(CrosnodeError):
    """A peer broke a protocol; the connection it came by must end."""


class DecodeError(RemoteProtocolError):
    """Received bytes are not a message of the expected type."""


class TcprosError(RemoteProtocolError):
    """A TCPROS header or frame is wrong, or the peer refused ours."""


class XmlRpcError(RemoteProtocolError):
    """A message is not XML-RPC over HTTP."""


class LimitError(XmlRpcError):
    """A message is larger or deeper than we accept."""
