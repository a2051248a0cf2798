"""TCPROS, the protocol of ROS 1 topics and services, without input and output."""

from crosnode.tcpros.connection import (
    Closed,
    Connection,
    Event,
    Failed,
    HeaderReceived,
    Limits,
    MessageReceived,
    Refused,
    ReplyReceived,
    RequestReceived,
    State,
    TypeInfo,
)
from crosnode.tcpros.header import ANY
from crosnode.tcpros.service import ServiceClientConnection, ServiceServerConnection
from crosnode.tcpros.topic import PublisherConnection, SubscriberConnection

__all__ = [
    "ANY",
    "Closed",
    "Connection",
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
    "TypeInfo",
]
