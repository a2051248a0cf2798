"""TCP and UDP as blocks need them: never blocking, never raising, on the host's or a virtual net.

``OsNetwork`` uses the sockets of the host. ``VirtualNetwork`` simulates hosts on one net, in
virtual time, with faults at will. Both pass the suite in ``tests/contracts/network_contract.py``.
"""

from plcsim.network.datagrams import (
    Datagram,
    DatagramNetwork,
    DatagramSocket,
    OpenedDatagrams,
    datagrams_of,
)
from plcsim.network.os_network import OsNetwork
from plcsim.network.protocol import (
    Accepted,
    Address,
    Filled,
    Network,
    Opened,
    Option,
    OptionValue,
    Outcome,
    Received,
    Sent,
    Socket,
    network_of,
)
from plcsim.network.virtual_network import VirtualNetwork
from plcsim.network.wire import Link, WireLimits

__all__ = [
    "Accepted",
    "Address",
    "Datagram",
    "DatagramNetwork",
    "DatagramSocket",
    "Filled",
    "Link",
    "Network",
    "Opened",
    "OpenedDatagrams",
    "Option",
    "OptionValue",
    "OsNetwork",
    "Outcome",
    "Received",
    "Sent",
    "Socket",
    "VirtualNetwork",
    "WireLimits",
    "datagrams_of",
    "network_of",
]
