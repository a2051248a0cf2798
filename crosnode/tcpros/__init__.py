"""TCPROS, the protocol of ROS 1 topics and services, without input and output."""

from crosnode.tcpros.connection import (
    HeaderReceived,
    MessagesReceived,
    Refused,
    ReplyReceived,
    RequestReceived,
    TcprosConnection,
    TcprosLimits,
    TypeInfo,
)
from crosnode.tcpros.header import ANY
from crosnode.tcpros.service import ServiceClientConnection, ServiceServerConnection
from crosnode.tcpros.topic import PublisherConnection, SubscriberConnection

__all__ = [
    "ANY",
    "HeaderReceived",
    "MessagesReceived",
    "PublisherConnection",
    "Refused",
    "ReplyReceived",
    "RequestReceived",
    "ServiceClientConnection",
    "ServiceServerConnection",
    "SubscriberConnection",
    "TcprosConnection",
    "TcprosLimits",
    "TypeInfo",
]
