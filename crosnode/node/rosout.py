"""The node's log: ``/rosout``, and the two services that set its level.

Source: wiki.ros.org/rosout, wiki.ros.org/roscpp/Overview/Logging.
"""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Final

from crosnode.messages import Time

if TYPE_CHECKING:
    from crosnode.node.node import CrosNode

LOGGER: Final = "ros.crosnode"
QUEUE: Final = 100


class LogLevel(IntEnum):
    """Levels of rosgraph_msgs/Log."""

    DEBUG = 1
    INFO = 2
    WARN = 4
    ERROR = 8
    FATAL = 16


class Rosout:
    """Publishes the node's log and answers for its level.

    Args:
        node: whose log it is.

    Attributes:
        level: entries below it are not published.
    """

    def __init__(self, node: CrosNode) -> None:
        self.level = LogLevel.INFO
        self._node = node
        self._publisher = node.register_publisher(
            "/rosout", "rosgraph_msgs/Log", queue_size=QUEUE, latching=True
        )
        self._get = node.register_service_provider("~get_loggers", "roscpp/GetLoggers")
        self._set = node.register_service_provider("~set_logger_level", "roscpp/SetLoggerLevel")
        for role in (self._publisher, self._get, self._set):
            role.registration.is_late = True
        self._logger = node.types.message("roscpp/Logger")

    def log(self, level: LogLevel, text: str, file: str, line: int, function: str) -> None:
        """Publish an entry, where its level is not below the node's."""
        if level < self.level:
            return
        entry = self._publisher.new(
            level=int(level),
            name=self._node.name,
            msg=text.encode(errors="replace").decode(),
            file=file,
            line=line,
            function=function,
            topics=list(self._node.publishers),
        )
        entry.header.stamp = Time.from_ns(self._node.now_ns)
        self._publisher.send(entry)

    def step(self) -> None:
        """Answer the services."""
        if request := self._get.pop():
            logger = self._logger.new(name=LOGGER, level=self.level.name.lower())
            request.respond(loggers=[logger])
        if request := self._set.pop():
            level = str(request.request.level).upper()
            if level in LogLevel.__members__:
                self.level = LogLevel[level]
                request.respond()
            else:
                request.fail(f"no level {level[:100]!r}")
