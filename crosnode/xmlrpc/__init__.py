"""XML-RPC over HTTP, the protocol of the ROS 1 master and slave APIs, without input and output."""

from crosnode.xmlrpc.connection import (
    CallReceived,
    Event,
    FaultReceived,
    Limits,
    Progress,
    ResponseReceived,
    XmlRpcClientConnection,
    XmlRpcConnection,
    XmlRpcServerConnection,
)
from crosnode.xmlrpc.multicall import MULTICALL, run_multicall
from crosnode.xmlrpc.values import (
    Call,
    Fault,
    Response,
    Value,
    ValueLimits,
    ValueParser,
)
from crosnode.xmlrpc.writer import check_value

__all__ = [
    "MULTICALL",
    "Call",
    "CallReceived",
    "Event",
    "Fault",
    "FaultReceived",
    "Limits",
    "Progress",
    "Response",
    "ResponseReceived",
    "Value",
    "ValueLimits",
    "ValueParser",
    "XmlRpcClientConnection",
    "XmlRpcConnection",
    "XmlRpcServerConnection",
    "check_value",
    "run_multicall",
]
