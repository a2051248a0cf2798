"""Which TCP ports this process may listen on."""

from __future__ import annotations

from pathlib import Path
from typing import Final

_FIRST: Final = Path("/proc/sys/net/ipv4/ip_unprivileged_port_start")
_STATUS: Final = Path("/proc/self/status")
_CAP_NET_BIND_SERVICE: Final = 10


def unprivileged_ports() -> int:
    """Return the first port that anybody may listen on: 1024, unless the host says otherwise.

    Source: Linux, Documentation/networking/ip-sysctl.rst, ip_unprivileged_port_start.
    """
    try:
        return int(_FIRST.read_text("ascii"))
    except (OSError, ValueError):
        return 1024


def remedy(port: int) -> str:
    """Return what to do where a port needs rights that are not given."""
    return (
        f"{port} needs root or CAP_NET_BIND_SERVICE, which are not given; another one, such as "
        "port = 1502, needs neither"
    )


def may_use_privileged_ports() -> bool:
    """Return True where this process has CAP_NET_BIND_SERVICE (capabilities(7)), as root has."""
    for line in _STATUS.read_text("utf-8").splitlines():
        if line.startswith("CapEff:"):
            return bool(int(line.split()[1], 16) >> _CAP_NET_BIND_SERVICE & 1)
    return False
