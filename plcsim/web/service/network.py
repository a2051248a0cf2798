"""The TCP sockets of the processes of a run, as the kernel tells them in /proc.

So the scan is not asked. Clients of Modbus, peers of AsTCP blocks and of the ROS node, and browsers
are all seen here, each with the process that holds its end.
"""

from __future__ import annotations

import ipaddress
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.web.service.socket_counts import socket_counts

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

MOST: Final = 500
"""Sockets that are told."""

_STATES: Final = {1: "connected", 2: "connecting", 3: "connecting", 10: "listening"}
_LEAVING: Final = "closing"
_SOCKET: Final = re.compile(r"socket:\[(\d+)\]")


class _Row(NamedTuple):
    """A line of /proc/net/tcp."""

    local: str
    peer: str
    state: int
    sending: int
    receiving: int
    inode: int


def sockets(processes: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Return the TCP sockets of processes (see `plcsim.web.service.host.processes`).

    "counts" is a `SocketCounts`, None where the kernel does not tell.
    """
    rows = {row.inode: row for file in ("tcp", "tcp6") for row in _rows(file)}
    counted = socket_counts()
    found: list[dict[str, Any]] = []
    for process in processes:
        for inode in _inodes(process["pid"]):
            row = rows.get(inode)
            if row is not None and len(found) < MOST:
                found.append(
                    {
                        "process": process["name"],
                        "local": row.local,
                        "peer": "" if row.state == 10 else row.peer,
                        "state": _STATES.get(row.state, _LEAVING),
                        "to_send": row.sending,
                        "to_read": row.receiving,
                        "counts": counted.get(row.inode),
                    }
                )
    return sorted(found, key=lambda each: (each["process"], each["state"], each["peer"]))


def _inodes(pid: int) -> Iterator[int]:
    try:
        files = list(Path(f"/proc/{pid}/fd").iterdir())
    except OSError:  # it has gone, or belongs to somebody else
        return
    for file in files:
        try:
            match = _SOCKET.fullmatch(str(file.readlink()))
        except OSError:
            continue
        if match:
            yield int(match[1])


def _rows(file: str) -> Iterator[_Row]:
    try:
        lines = Path(f"/proc/self/net/{file}").read_text().splitlines()[1:]
    except OSError:
        return
    for line in lines:
        words = line.split()
        sending, _, receiving = words[4].partition(":")
        yield _Row(
            _address(words[1]),
            _address(words[2]),
            int(words[3], 16),
            int(sending, 16),
            int(receiving, 16),
            int(words[9]),
        )


def _address(text: str) -> str:
    """Return an address of /proc/net/tcp as people write it: its words are in host order."""
    host, _, port = text.partition(":")
    words = [bytes.fromhex(host[at : at + 8])[::-1] for at in range(0, len(host), 8)]
    ip = ipaddress.ip_address(b"".join(words))
    mapped = getattr(ip, "ipv4_mapped", None) or ip
    shown = f"[{mapped}]" if mapped.version == 6 else str(mapped)
    return f"{shown}:{int(port, 16)}"
