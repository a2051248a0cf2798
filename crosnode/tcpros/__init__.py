"""TCPROS, the protocol of ROS 1 topics and services, without input and output."""

from crosnode.tcpros.connection import (
    Event,
    HeaderReceived,
    Limits,
    MessageReceived,
    Refused,
    ReplyReceived,
    RequestReceived,
    TcprosConnection,
    TypeInfo,
)
from crosnode.tcpros.header import ANY
from crosnode.tcpros.service import ServiceClientConnection, ServiceServerConnection
from crosnode.tcpros.topic import PublisherConnection, SubscriberConnection
from crosnode.transport.connection import Closed, Failed, State

__all__ = [
    "ANY",
    "Closed",
    "Event",
    "Failed",
    "HeaderReceived",
    "Limits",
    "MessageReceived",
    "PublisherConnection",
    "Refused",
    "ReplyReceived",
    "RequestReceived",
    "ServiceClientConnection",
    "ServiceServerConnection",
    "State",
    "SubscriberConnection",
    "TcprosConnection",
    "TypeInfo",
]
