"""XML-RPC over HTTP, the protocol of the ROS 1 master and slave APIs, without input and output."""

from crosnode.xmlrpc.connection import (
    CallReceived,
    FaultReceived,
    LastUse,
    ResponseReceived,
    Unreadable,
    XmlRpcClientConnection,
    XmlRpcConnection,
    XmlRpcLimits,
    XmlRpcServerConnection,
)
from crosnode.xmlrpc.multicall import MULTICALL, run_multicall
from crosnode.xmlrpc.values import (
    MethodCall,
    MethodFault,
    MethodResponse,
    Value,
    ValueLimits,
    ValueParser,
)
from crosnode.xmlrpc.writer import check_value

__all__ = [
    "MULTICALL",
    "CallReceived",
    "FaultReceived",
    "LastUse",
    "MethodCall",
    "MethodFault",
    "MethodResponse",
    "ResponseReceived",
    "Unreadable",
    "Value",
    "ValueLimits",
    "ValueParser",
    "XmlRpcClientConnection",
    "XmlRpcConnection",
    "XmlRpcLimits",
    "XmlRpcServerConnection",
    "check_value",
    "run_multicall",
]
