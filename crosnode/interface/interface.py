"""Library CrosNode as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside
from st_types import Struct

if TYPE_CHECKING:
    from plcsim.library.astcp import TcpClose, TcpOpen, TcpRecv, TcpSend, TcpServer
    from st_types import Array

__all__ = [
    "CROS_IP_LENGTH",
    "CROS_MAX_PARAM_SUBSCRIPTIONS",
    "CROS_MAX_PUBLISHED_TOPICS",
    "CROS_MAX_QUEUE",
    "CROS_MAX_RPCROS_SERVER",
    "CROS_MAX_SERVICE_PROVIDERS",
    "CROS_MAX_SUBSCRIBED_TOPICS",
    "CROS_MAX_TCPROS_CLIENT",
    "CROS_MAX_TCPROS_SERVER",
    "CROS_MAX_XMLRPC_CLIENT",
    "CROS_MAX_XMLRPC_SERVER",
    "CROS_MD5_LENGTH",
    "CROS_NAME_LENGTH",
    "CROS_TEXT_LENGTH",
    "ApiCallQueue",
    "CrosAdjustableKind",
    "CrosApiMethod",
    "CrosDiagnosticLevel",
    "CrosGoalState",
    "CrosLog",
    "CrosLogLevel",
    "CrosLogQueue",
    "CrosMessageType",
    "CrosNewsKind",
    "CrosNode",
    "CrosNodeNews",
    "CrosNodeStatus",
    "CrosNodeStatusUsr",
    "CrosTime",
    "CrosTransform",
    "DynBuffer",
    "DynString",
    "ParameterSubscription",
    "PublisherNode",
    "QueueArgExtFun",
    "QueueStatus",
    "RosApiCall",
    "ServiceProviderNode",
    "SubscriberNode",
    "TcpipSocket",
    "TcpipSocketState",
    "TcprosProcess",
    "TcprosProcessState",
    "XmlrpcMessageType",
    "XmlrpcParam",
    "XmlrpcParamType",
    "XmlrpcParamVector",
    "XmlrpcProcess",
    "XmlrpcProcessState",
    "cRosMessage",
    "cRosMessageField",
    "crosERR_CUT",
    "crosERR_FIELD",
    "crosERR_FULL",
    "crosERR_GONE",
    "crosERR_HANDLE",
    "crosERR_NO_MASTER",
    "crosERR_NO_TRANSFORM",
    "crosERR_REFUSED",
    "crosERR_STATE",
    "crosERR_STRUCT",
    "crosERR_VALUE",
]

_DECLARED = declared_beside(__name__)

CROS_MAX_XMLRPC_CLIENT: Final = 5
"""Highest index; connection 0 is the master's."""

CROS_MAX_XMLRPC_SERVER: Final = 4
"""Highest index."""

CROS_MAX_TCPROS_CLIENT: Final = 5
"""Highest index."""

CROS_MAX_TCPROS_SERVER: Final = 4
"""Highest index."""

CROS_MAX_RPCROS_SERVER: Final = 7
"""Highest index."""

CROS_MAX_PUBLISHED_TOPICS: Final = 4
"""Highest index."""

CROS_MAX_SUBSCRIBED_TOPICS: Final = 4
"""Highest index."""

CROS_MAX_SERVICE_PROVIDERS: Final = 7
"""Highest index."""

CROS_MAX_PARAM_SUBSCRIPTIONS: Final = 19
"""Highest index."""

CROS_MAX_QUEUE: Final = 9
"""Highest index of a queue."""

CROS_IP_LENGTH: Final = 15
"""Characters of an IPv4 address."""

CROS_NAME_LENGTH: Final = 80
"""Characters of a name, a type, a host."""

CROS_TEXT_LENGTH: Final = 255
"""Characters of a log text, a path."""

CROS_MD5_LENGTH: Final = 32
"""Characters of an md5 sum."""

crosERR_HANDLE: Final = 50200
"""No such handle, or of another kind."""

crosERR_FIELD: Final = 50201
"""No such field, or no such element."""

crosERR_VALUE: Final = 50202
"""The field cannot hold the value."""

crosERR_STRUCT: Final = 50203
"""No STRUCT of this type, or of another size."""

crosERR_CUT: Final = 50204
"""Done, but a list or a text was longer than its bound."""

crosERR_GONE: Final = 50205
"""The request was answered, or its caller has left."""

crosERR_REFUSED: Final = 50206
"""The master or the provider refuses."""

crosERR_NO_MASTER: Final = 50207
"""The master cannot be reached."""

crosERR_STATE: Final = 50208
"""The goal's state does not allow it."""

crosERR_NO_TRANSFORM: Final = 50209
"""No such frames, no way between them, or none at that time."""

crosERR_FULL: Final = 50210
"""A bound is reached, such as that of static frames or components."""


class CrosGoalState(IntEnum):
    """Enumeration CrosGoalState."""

    CROS_GOAL_PENDING = 0
    CROS_GOAL_ACTIVE = 1
    CROS_GOAL_PREEMPTED = 2
    CROS_GOAL_SUCCEEDED = 3
    CROS_GOAL_ABORTED = 4
    CROS_GOAL_REJECTED = 5
    CROS_GOAL_PREEMPTING = 6
    CROS_GOAL_RECALLING = 7
    CROS_GOAL_RECALLED = 8
    CROS_GOAL_LOST = 9


_DECLARED.enumeration(CrosGoalState)


class CrosTransform(Struct):
    """From a frame to its parent: rotate, then translate."""

    _plc_type = _DECLARED["CrosTransform"]

    x: float
    """M."""

    y: float

    z: float

    qx: float
    """Unit quaternion."""

    qy: float

    qz: float

    qw: float


class CrosDiagnosticLevel(IntEnum):
    """Enumeration CrosDiagnosticLevel."""

    CROS_DIAGNOSTIC_OK = 0
    CROS_DIAGNOSTIC_WARN = 1
    CROS_DIAGNOSTIC_ERROR = 2
    CROS_DIAGNOSTIC_STALE = 3


_DECLARED.enumeration(CrosDiagnosticLevel)


class CrosAdjustableKind(IntEnum):
    """Enumeration CrosAdjustableKind."""

    CROS_ADJUSTABLE_BOOL = 0
    CROS_ADJUSTABLE_INT = 1
    CROS_ADJUSTABLE_REAL = 2


_DECLARED.enumeration(CrosAdjustableKind)


class CrosMessageType(IntEnum):
    """Enumeration CrosMessageType."""

    CROS_CUSTOM_TYPE = 0
    CROS_STD_MSGS_INT8 = 1
    CROS_STD_MSGS_UINT8 = 2
    CROS_STD_MSGS_INT16 = 3
    CROS_STD_MSGS_UINT16 = 4
    CROS_STD_MSGS_INT32 = 5
    CROS_STD_MSGS_UINT32 = 6
    CROS_STD_MSGS_INT64 = 7
    CROS_STD_MSGS_UINT64 = 8
    CROS_STD_MSGS_FLOAT32 = 9
    CROS_STD_MSGS_FLOAT64 = 10
    CROS_STD_MSGS_STRING = 11
    CROS_STD_MSGS_BOOL = 12
    CROS_STD_MSGS_TIME = 13
    CROS_STD_MSGS_DURATION = 14
    CROS_STD_MSGS_HEADER = 15
    CROS_STD_MSGS_CHAR = 16
    CROS_STD_MSGS_BYTE = 17


_DECLARED.enumeration(CrosMessageType)


class cRosMessageField(Struct):
    """One field."""

    _plc_type = _DECLARED["cRosMessageField"]

    name: str

    data: int
    """The union of C: the bits of a number, the address of a string or an array, a handle."""

    size: int
    """Bytes."""

    is_const: int

    is_array: int

    is_fixed_array: int

    array_size: int
    """Elements that are valid."""

    array_capacity: int
    """Elements there is room for."""

    field_type: CrosMessageType
    """Type in C."""

    type_s: str
    """Name of the type."""


class cRosMessage(Struct):
    """A message."""

    _plc_type = _DECLARED["cRosMessage"]

    fields: int
    """The first of n_fields."""

    msgDef: int
    """Handle of the definition."""

    md5sum: str

    n_fields: int


class CrosNewsKind(IntEnum):
    """Enumeration CrosNewsKind."""

    CROS_NEWS_NONE = 0
    CROS_NEWS_REGISTERED = 1
    CROS_NEWS_UNREGISTERED = 2
    CROS_NEWS_REGISTRATION_REFUSED = 3
    CROS_NEWS_CONNECTED = 4
    CROS_NEWS_DISCONNECTED = 5
    CROS_NEWS_PEER_REFUSED = 6
    CROS_NEWS_BAD_MESSAGE = 7
    CROS_NEWS_MASTER_FOUND = 8
    CROS_NEWS_MASTER_LOST = 9
    CROS_NEWS_PARAM_SUBSCRIBED = 10
    CROS_NEWS_PARAM_UPDATE = 11
    CROS_NEWS_NAME_TAKEN = 12
    CROS_NEWS_SHUTDOWN = 13
    CROS_NEWS_NO_IDENT = 14
    CROS_NEWS_BEHIND = 15


_DECLARED.enumeration(CrosNewsKind)


class CrosNodeNews(Struct):
    """An event for the program, in place of figure 1.7."""

    _plc_type = _DECLARED["CrosNodeNews"]

    kind: CrosNewsKind

    name: str
    """Topic, service, parameter or node it happened to."""

    text: str
    """More of it, for people."""


class CrosTime(Struct):
    """ROS time."""

    _plc_type = _DECLARED["CrosTime"]

    sec: int

    nsec: int


class PublisherNode(Struct):
    """A topic that the node publishes (figure 1.10)."""

    _plc_type = _DECLARED["PublisherNode"]

    topic_name: str

    topic_type: str

    md5sum: str

    message_definition: DynString

    client_tcpros_id: int
    """Connection."""

    queue_pubs: int

    queue_status: int

    msg: int

    loop_period: int
    """Ms."""


class SubscriberNode(Struct):
    """A topic that the node subscribes to (figure 1.11)."""

    _plc_type = _DECLARED["SubscriberNode"]

    message_definition: DynString

    topic_name: str

    topic_type: str

    md5sum: str

    topic_host: str
    """Publisher."""

    topic_port: int

    client_xmlrpc_id: int
    """Connection."""

    client_tcpros_id: int
    """Connection."""

    tcpros_id: int

    queue_subs: int

    queue_status: int

    msg: int


class ServiceProviderNode(Struct):
    """A service that the node offers (figure 1.12)."""

    _plc_type = _DECLARED["ServiceProviderNode"]

    service_name: str

    service_type: str

    servicerequest_type: str

    serviceresponse_type: str

    md5sum: str

    queue_services: int

    queue_status: int


class ParameterSubscription(Struct):
    """A parameter that the node follows."""

    _plc_type = _DECLARED["ParameterSubscription"]

    parameter_key: str

    parameter_value: XmlrpcParam

    queue_status: int


class CrosNode(Struct):
    """All of a node."""

    _plc_type = _DECLARED["CrosNode"]

    name: str
    """With its namespace."""

    host: str

    xmlrpc_port: int

    tcpros_port: int

    rpcros_port: int

    select_timeout: int
    """Ms."""

    pid: int

    roscore_pid: int

    roscore_host: str

    roscore_port: int

    message_root_path: str
    """Folder of the definitions."""

    log_level: CrosLogLevel

    log_queue: int

    log_last_id: int

    next_call_id: int

    master_api_queue: ApiCallQueue

    slave_api_queue: ApiCallQueue

    xmlrpc_client_proc: Array[XmlrpcProcess]

    xmlrpc_listner_proc: XmlrpcProcess

    xmlrpc_server_proc: Array[XmlrpcProcess]

    tcpros_client_proc: Array[TcprosProcess]

    tcpros_listner_proc: TcprosProcess

    tcpros_server_proc: Array[TcprosProcess]

    rpcros_listner_proc: TcprosProcess

    rpcros_server_proc: Array[TcprosProcess]

    pubs: Array[PublisherNode]

    subs: Array[SubscriberNode]

    services: Array[ServiceProviderNode]

    paramsubs: Array[ParameterSubscription]

    n_pubs: int

    n_subs: int

    n_services: int

    n_paramsubs: int


class XmlrpcParamType(IntEnum):
    """Enumeration XmlrpcParamType."""

    XMLRPC_PARAM_UNKNOWN = 0
    XMLRPC_PARAM_BOOL = 1
    XMLRPC_PARAM_INT = 2
    XMLRPC_PARAM_DOUBLE = 3
    XMLRPC_PARAM_STRING = 4
    XMLRPC_PARAM_ARRAY = 5
    XMLRPC_PARAM_DATETIME = 6
    XMLRPC_PARAM_BINARY = 7
    XMLRPC_PARAM_STRUCT = 8


_DECLARED.enumeration(XmlrpcParamType)


class XmlrpcParam(Struct):
    """A value; elements of an array or a struct lie elsewhere."""

    _plc_type = _DECLARED["XmlrpcParam"]

    param_type: XmlrpcParamType
    """Type in C."""

    member_name: str
    """Inside a struct."""

    data: int
    """The union of C: the bits of a number, or the address of text or elements."""

    array_n_elem: int
    """Elements that are valid."""

    array_max_elem: int
    """Elements there is room for."""


class XmlrpcParamVector(Struct):
    """Values of a call or an answer."""

    _plc_type = _DECLARED["XmlrpcParamVector"]

    size: int
    """Values that are valid."""

    max: int
    """Values there is room for."""

    data: int
    """The first."""


class XmlrpcMessageType(IntEnum):
    """Enumeration XmlrpcMessageType."""

    XMLRPC_MESSAGE_REQUEST = 0
    XMLRPC_MESSAGE_RESPONSE = 1
    XMLRPC_MESSAGE_UNKNOWN = 2


_DECLARED.enumeration(XmlrpcMessageType)


class XmlrpcProcessState(IntEnum):
    """Enumeration XmlrpcProcessState."""

    XMLRPC_PROCESS_STATE_IDLE = 0
    XMLRPC_PROCESS_STATE_CONNECTING = 1
    XMLRPC_PROCESS_STATE_READING = 2
    XMLRPC_PROCESS_STATE_WRITING = 3


_DECLARED.enumeration(XmlrpcProcessState)


class XmlrpcProcess(Struct):
    """A connection with the master or another node."""

    _plc_type = _DECLARED["XmlrpcProcess"]

    current_call: int
    """Handle of a RosApiCall."""

    state: XmlrpcProcessState

    socket: TcpipSocket

    message_type: XmlrpcMessageType

    method: DynString

    params: XmlrpcParamVector

    response: XmlrpcParamVector

    message: DynString
    """As it goes over the wire."""

    last_change_time: int
    """Ms."""

    host: str

    port: int


class TcprosProcessState(IntEnum):
    """Enumeration TcprosProcessState."""

    TCPROS_STATE_IDLE = 0
    TCPROS_STATE_WAIT_FOR_CONNECTING = 1
    TCPROS_STATE_CONNECTING = 2
    TCPROS_STATE_READING_HEADER_SIZE = 3
    TCPROS_STATE_READING_HEADER = 4
    TCPROS_STATE_WRITING_HEADER = 5
    TCPROS_STATE_WAIT_FOR_WRITING = 6
    TCPROS_STATE_START_WRITING = 7
    TCPROS_STATE_READING_SIZE = 8
    TCPROS_STATE_READING = 9
    TCPROS_STATE_WRITING = 10


_DECLARED.enumeration(TcprosProcessState)


class TcprosProcess(Struct):
    """A connection for a topic or a service."""

    _plc_type = _DECLARED["TcprosProcess"]

    state: TcprosProcessState

    socket: TcpipSocket

    topic: DynString

    service: DynString

    msg_type: DynString
    """Type in C."""

    servicerequest_type: DynString

    serviceresponse_type: DynString

    md5sum: DynString

    caller_id: DynString
    """Node at the other end."""

    latching: int
    """1: the last message is sent to new subscribers."""

    tcp_nodelay: int

    persistent: int
    """1: several requests on one connection."""

    packet: DynBuffer
    """Message that comes or goes."""

    last_change_time: int
    """Ms."""

    topic_idx: int
    """Index of the publisher or subscriber."""

    service_idx: int
    """Index of the service."""

    left_to_recv: int
    """Bytes."""

    ok_byte: int
    """Answer of a service."""

    probe: int
    """The caller only looks whether the service is there."""

    sub_tcpros_port: int
    """Publisher to connect with."""

    sub_tcpros_host: str


class CrosNodeStatus(IntEnum):
    """Enumeration CrosNodeStatus."""

    CROS_STATUS_NONE = 0
    CROS_STATUS_PUBLISHER_UNREG = 1
    CROS_STATUS_SUBSCRIBER_UNREG = 2
    CROS_STATUS_SERVICE_UNREG = 3
    CROS_STATUS_PARAM_UNSUBSCRIBED = 4
    CROS_STATUS_PARAM_SUBSCRIBED = 5
    CROS_STATUS_PARAM_UPDATE = 6


_DECLARED.enumeration(CrosNodeStatus)


class CrosNodeStatusUsr(Struct):
    """An event for the program (figure 1.7)."""

    _plc_type = _DECLARED["CrosNodeStatusUsr"]

    state: CrosNodeStatus

    provider_idx: int
    """Index of the publisher, subscriber or service."""

    xmlrpc_host: str

    xmlrpc_port: int

    parameter_key: str

    parameter_value: int


class QueueArgExtFun(Struct):
    """A packet (figure 1.8)."""

    _plc_type = _DECLARED["QueueArgExtFun"]

    packet: int

    next: int
    """Handle of a QueueArgExtFun."""


class QueueStatus(Struct):
    """An event (figure 1.9)."""

    _plc_type = _DECLARED["QueueStatus"]

    status: CrosNodeStatusUsr

    next: int
    """Handle of a QueueStatus."""


class CrosLogLevel(IntEnum):
    """Enumeration CrosLogLevel."""

    CROS_LOGLEVEL_DEBUG = 1
    CROS_LOGLEVEL_INFO = 2
    CROS_LOGLEVEL_WARN = 4
    CROS_LOGLEVEL_ERROR = 8
    CROS_LOGLEVEL_FATAL = 16


_DECLARED.enumeration(CrosLogLevel)


class CrosLog(Struct):
    """A line for /rosout."""

    _plc_type = _DECLARED["CrosLog"]

    level: int

    name: str
    """Of the node."""

    msg: str

    file: str

    function_name: str
    """Function in C."""

    line: int

    pubs: Array[str]

    secs: int

    nsecs: int

    n_pubs: int


class CrosLogQueue(Struct):
    """Lines that wait for their publication."""

    _plc_type = _DECLARED["CrosLogQueue"]

    entries: Array[CrosLog]

    head: int
    """Index of the oldest."""

    count: int


class CrosApiMethod(IntEnum):
    """Enumeration CrosApiMethod."""

    CROS_API_NONE = 0
    CROS_API_REGISTER_SERVICE = 1
    CROS_API_UNREGISTER_SERVICE = 2
    CROS_API_UNREGISTER_PUBLISHER = 3
    CROS_API_UNREGISTER_SUBSCRIBER = 4
    CROS_API_REGISTER_PUBLISHER = 5
    CROS_API_REGISTER_SUBSCRIBER = 6
    CROS_API_LOOKUP_NODE = 7
    CROS_API_GET_PUBLISHED_TOPICS = 8
    CROS_API_GET_TOPIC_TYPES = 9
    CROS_API_GET_SYSTEM_STATE = 10
    CROS_API_GET_URI = 11
    CROS_API_LOOKUP_SERVICE = 12
    CROS_API_GET_BUS_STATS = 13
    CROS_API_GET_BUS_INFO = 14
    CROS_API_GET_MASTER_URI = 15
    CROS_API_SHUTDOWN = 16
    CROS_API_GET_PID = 17
    CROS_API_GET_SUBSCRIPTIONS = 18
    CROS_API_GET_PUBLICATIONS = 19
    CROS_API_PARAM_UPDATE = 20
    CROS_API_PUBLISHER_UPDATE = 21
    CROS_API_REQUEST_TOPIC = 22


_DECLARED.enumeration(CrosApiMethod)


class RosApiCall(Struct):
    """A call that waits or runs."""

    _plc_type = _DECLARED["RosApiCall"]

    id: int

    method: CrosApiMethod

    params: XmlrpcParamVector

    host: str
    """Who is called."""

    port: int

    provider_idx: int
    """Index of the publisher, subscriber or service it is for."""


class ApiCallQueue(Struct):
    """Calls that wait."""

    _plc_type = _DECLARED["ApiCallQueue"]

    calls: Array[RosApiCall]

    head: int
    """Index of the oldest."""

    count: int


class TcpipSocketState(IntEnum):
    """Enumeration TcpipSocketState."""

    TCPIP_SOCKET_FAILED = 0
    TCPIP_SOCKET_IN_PROGRESS = 1
    TCPIP_SOCKET_DISCONNECTED = 2
    TCPIP_SOCKET_DONE = 3
    TCPIP_SOCKET_UNKNOWN = 4


_DECLARED.enumeration(TcpipSocketState)


class TcpipSocket(Struct):
    """A connection and the blocks that work for it."""

    _plc_type = _DECLARED["TcpipSocket"]

    open_ready: bool
    """TcpOpen has its inputs."""

    serv_ready: bool

    recv_ready: bool

    send_ready: bool

    close_ready: bool

    maxLength: int
    """Bytes that one call moves at most."""

    ipAddr: str
    """Of the peer."""

    TcpOpen_1: TcpOpen

    TcpServer_1: TcpServer

    TcpSend_1: TcpSend

    TcpClose_1: TcpClose

    TcpRecv_1: TcpRecv


class DynBuffer(Struct):
    """Bytes that grow as they come."""

    _plc_type = _DECLARED["DynBuffer"]

    size: int
    """Bytes that are valid."""

    pos_offset: int
    """Place of the next read."""

    max: int
    """Bytes there is room for."""

    data: int
    """Address."""


class DynString(Struct):
    """Text that grows as it comes."""

    _plc_type = _DECLARED["DynString"]

    len: int
    """Characters."""

    pos_offset: int
    """Place of the next read."""

    max: int
    """Characters there is room for."""

    data: int
    """Address."""


class cRosApiSetParam(FunctionBlock):
    """Sets a parameter; asynchronous."""

    _plc_type = _DECLARED["cRosApiSetParam"]

    enable: bool
    """Run the block; FALSE resets it."""

    node: int

    key: str

    value: str
    """A number, true, false, JSON, or a text."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or crosERR_."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_call: int
    """The call to the master that is under way."""


class cRosApiGetParam(FunctionBlock):
    """Asks for a parameter; asynchronous."""

    _plc_type = _DECLARED["cRosApiGetParam"]

    enable: bool
    """Run the block; FALSE resets it."""

    node: int

    key: str

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or crosERR_."""

    value: str
    """As JSON."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_call: int
    """The call to the master that is under way."""
