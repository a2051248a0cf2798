"""HTTP/1.1 without a Host field, which some XML-RPC clients send and rospy and roscpp serve.

h11 refuses such a request, as RFC 9112 (3.2) asks of a server. An API that has one address needs no
Host, so an empty field is put behind the others before h11 reads them.
"""

from __future__ import annotations

from typing import Final

_FIELD: Final = b"host:"
_LONGEST: Final = len(_FIELD)


class HostField:
    """Completes the head of each request; bytes go on as they come, but for the last line's."""

    def __init__(self) -> None:
        self.begin()

    def begin(self) -> None:
        """Expect the head of the next request.

        Of requests that come before the last one is answered, only the first is completed; ROS
        clients wait for the answer.
        """
        self._is_in_head = True
        self._has_host = False
        self._lines = 0
        self._start = b""

    def complete(self, data: bytes) -> bytes:
        """Return received bytes, with the field where the head ends without one."""
        passed = []
        while self._is_in_head and data:
            line, newline, data = data.partition(b"\n")
            passed.append(self._take(line, newline))
        return b"".join(passed) + data

    def _take(self, part: bytes, newline: bytes) -> bytes:
        """Return a part of a line as it goes on; a line that may be the last waits for its end."""
        held = self._start if self._start == b"\r" else b""
        self._start = (self._start + part)[:_LONGEST]
        if not newline:
            return b"" if self._start == b"\r" else held + part
        is_last = self._start in (b"", b"\r") and self._lines > 0
        self._has_host = self._has_host or self._start.lower() == _FIELD
        self._lines += 1
        self._start = b""
        if not is_last:
            return held + part + newline
        self._is_in_head = False
        return (b"" if self._has_host else b"Host:\r\n") + held + part + newline
