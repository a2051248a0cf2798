"""The node of ROS 1, for programs: publishers, subscribers, services, parameters, log."""

from crosnode.node.master_client import MasterClient
from crosnode.node.node import CrosNode
from crosnode.node.options import NodeOptions
from crosnode.node.parameter import ParameterSubscription, ParameterUpdate
from crosnode.node.publisher import Publisher
from crosnode.node.rosout import LogLevel
from crosnode.node.service_caller import ServiceCaller, ServiceReply
from crosnode.node.service_provider import ServiceProvider, ServiceRequest
from crosnode.node.status import Status, StatusKind
from crosnode.node.subscriber import Subscriber

__all__ = [
    "CrosNode",
    "LogLevel",
    "MasterClient",
    "NodeOptions",
    "ParameterSubscription",
    "ParameterUpdate",
    "Publisher",
    "ServiceCaller",
    "ServiceProvider",
    "ServiceReply",
    "ServiceRequest",
    "Status",
    "StatusKind",
    "Subscriber",
]
