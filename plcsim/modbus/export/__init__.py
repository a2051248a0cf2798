"""The map in the words of other tools: each format counts addresses in its own way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.modbus.export.flows import fuxa, node_red
from plcsim.modbus.export.scada import ignition, kepware, modpoll, telegraf
from plcsim.modbus.export.tables import as_csv, as_json, as_markdown

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.modbus.export.entry import MapExport

FORMATS: Mapping[str, Callable[[MapExport], str]] = {
    "csv": as_csv,
    "json": as_json,
    "markdown": as_markdown,
    "fuxa": fuxa,
    "nodered": node_red,
    "modpoll": modpoll,
    "telegraf": telegraf,
    "kepware": kepware,
    "ignition": ignition,
}
"""By name, as in ``plcsim tags export --format NAME``."""
