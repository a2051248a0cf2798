"""Table [ros2] of plc.toml: the same entries as those of the bridge of [ros]."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from crosnode.errors import CrosnodeError
from crosnode.graph.names import check_name
from crosnode.plc.settings import Publication, Subscription
from plcsim.core.errors import Findings
from plcsim.settings import PathTo, Whole, settings

if TYPE_CHECKING:
    from plcsim.settings import Table

LAST_DOMAIN: Final = 232
"""The last for which DDS has ports (DDSI-RTPS 2.2, 9.6.1.3)."""


@settings
class Ros2Table:
    """The keys of [ros2].

    Attributes:
        domain: number of the ROS 2 network, None for ROS_DOMAIN_ID or 0.
        packages: folders of message packages, searched first.
        publish: tags to topics, by topic.
        subscribe: topics to tags, by topic.
    """

    domain: Annotated[int, Whole(0, LAST_DOMAIN)] | None = None
    packages: tuple[Annotated[Path, PathTo("folder")], ...] = ()
    publish: Mapping[str, Publication] = field(default_factory=dict)
    subscribe: Mapping[str, Subscription] = field(default_factory=dict)


@dataclass(frozen=True)
class Ros2Settings:
    """What [ros2] and the environment say.

    Attributes:
        file: plc.toml, for errors.
        table: the keys.
        domain: see `Ros2Table`.
    """

    file: Path
    table: Ros2Table
    domain: int


def read_settings(table: Table) -> Ros2Settings:
    """Read [ros2].

    Raises:
        ConfigurationError: something is wrong; file and fields are named.
    """
    keys = table.read(Ros2Table)
    findings = Findings()
    for key in ("publish", "subscribe"):
        for topic in getattr(keys, key):
            try:
                check_name(topic)
            except CrosnodeError as error:
                findings.add(table.error(f"{key}.{topic}", str(error)))
    text = os.environ.get("ROS_DOMAIN_ID", "") or "0"
    if keys.domain is None and not (text.isdecimal() and int(text) <= LAST_DOMAIN):
        findings.add(table.error("domain", f"ROS_DOMAIN_ID is {text!r}, not 0 to {LAST_DOMAIN}"))
    findings.check()
    domain = int(text) if keys.domain is None else keys.domain
    return Ros2Settings(table.folder / "plc.toml", keys, domain)
