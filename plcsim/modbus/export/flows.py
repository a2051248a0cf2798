"""A flow for Node-RED and a device for FUXA."""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING, Any

from plcsim.modbus.export.entry import extent
from plcsim.modbus.map.point import Area

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.modbus.export.entry import ExportEntry, MapExport

_NODE_RED_TYPES = {
    Area.COILS: "Coil",
    Area.DISCRETE_INPUTS: "Input",
    Area.INPUT_REGISTERS: "InputRegister",
    Area.HOLDING_REGISTERS: "HoldingRegister",
}


def _id(*parts: object) -> str:
    """Return an identifier that stays the same from export to export."""
    return hashlib.sha256("/".join(map(str, parts)).encode()).hexdigest()[:16]


def node_red(export: MapExport) -> str:
    """Return a flow of node-red-contrib-modbus: reads every block, names the values."""
    tab, server = _id(export.project, "tab"), _id(export.project, "server")
    nodes: list[dict[str, Any]] = [
        {"id": tab, "type": "tab", "label": export.project},
        {
            "id": server, "type": "modbus-client", "name": export.project, "clienttype": "tcp",
            "bufferCommands": True, "stateLogEnabled": False, "tcpHost": export.host,
            "tcpPort": str(export.port), "tcpType": "DEFAULT", "unit_id": "1",
            "commandDelay": "1", "clientTimeout": "1000", "reconnectOnTimeout": True,
            "reconnectTimeout": "2000", "parallelUnitIdsAllowed": True,
        },
    ]  # fmt: skip
    for area, kind in _NODE_RED_TYPES.items():
        for number, block in enumerate(export.blocks(area)):
            first, count = extent(block)
            read, name = _id(tab, area, number, "read"), _id(tab, area, number, "name")
            debug = _id(tab, area, number, "debug")
            label = f"{area.value} {first}"
            y = 60 * len(nodes)
            nodes += [
                {
                    "id": read, "type": "modbus-read", "z": tab, "name": label, "topic": "",
                    "showStatusActivities": False, "showErrors": True, "unitid": "1",
                    "dataType": kind, "adr": str(first), "quantity": str(count), "rate": "1",
                    "rateUnit": "s", "delayOnStart": False, "startDelayTime": "",
                    "server": server, "x": 140, "y": y, "wires": [[name], []],
                },
                {
                    "id": name, "type": "function", "z": tab, "name": "names",
                    "func": _names_function(block, first), "outputs": 1, "x": 340, "y": y,
                    "wires": [[debug]],
                },
                {
                    "id": debug, "type": "debug", "z": tab, "name": label, "active": True,
                    "tosidebar": True, "complete": "payload", "x": 540, "y": y, "wires": [],
                },
            ]  # fmt: skip
    return json.dumps(nodes, indent=2) + "\n"


_READERS = {
    "h": "readInt16BE", "H": "readUInt16BE", "i": "readInt32BE", "I": "readUInt32BE",
    "q": "readBigInt64BE", "Q": "readBigUInt64BE", "f": "readFloatBE", "d": "readDoubleBE",
}  # fmt: skip

_HELPER = """const raw = msg.payload;
const bytes = (first, count, order) => {
    let words = raw.slice(first, first + count).map(w =>
        order === "BADC" || order === "DCBA" ? ((w & 255) << 8) | (w >> 8) : w);
    if (order === "CDAB" || order === "DCBA") words = words.reverse();
    const out = Buffer.alloc(2 * count);
    words.forEach((w, i) => out.writeUInt16BE(w, 2 * i));
    return out;
};
"""


def _names_function(block: Sequence[ExportEntry], first: int) -> str:
    """Return JavaScript that turns the values of a block into an object of named values."""
    lines = [_HELPER, "msg.payload = {"]
    for entry in block:
        lines.append(f"    {json.dumps(entry.unique_name)}: {_expression(entry, first)},")
    return "\n".join([*lines, "};", "return msg;"])


def _expression(entry: ExportEntry, first: int) -> str:
    point = entry.point
    at = point.offset - first
    if not entry.area.has_registers:
        return f"raw[{at}]"
    if point.bit >= 0:
        return f"(raw[{at}] >> {point.bit} & 1) === 1"
    if point.kind == "?":
        return f"raw[{at}] !== 0"
    order = json.dumps(point.order)
    if point.kind == "s":
        plain = {"CDAB": "ABCD", "DCBA": "BADC"}.get(point.order, point.order)
        cut = 'toString("latin1").replace(/\\0.*$/s, "")'
        return f"bytes({at}, {point.registers}, {json.dumps(plain)}).{cut}"
    value = f"bytes({at}, {point.registers}, {order}).{_READERS[point.kind]}()"
    if point.is_scaled:
        value = f"{value} * {point.scale!r} + {point.offset_eu!r}"
    return f"{value}.toString()" if point.kind in "qQ" else value


_FUXA_AREAS = {
    Area.COILS: "000000",
    Area.DISCRETE_INPUTS: "100000",
    Area.INPUT_REGISTERS: "300000",
    Area.HOLDING_REGISTERS: "400000",
}
_FUXA_TYPES = {
    "?": "Bool", "h": "Int16", "H": "UInt16", "i": "Int32", "I": "UInt32", "q": "Int64",
    "f": "Float32", "d": "Float64",
}  # fmt: skip


def fuxa(export: MapExport) -> str:
    """Return a device of FUXA; strings, bits of registers and UINT64 are unknown to it."""
    device = "d_" + _id(export.project, "device")
    tags = {
        f"t_{_id(device, entry.unique_name)}": _fuxa_tag(device, entry)
        for entry in export.entries
        if _fuxa_type(entry)
    }
    value = {
        "id": device,
        "name": export.project,
        "enabled": True,
        "type": "ModbusTCP",
        "polling": 1000,
        "property": {
            "address": f"{export.host}:{export.port}",
            "port": str(export.port),
            "slaveid": "1",
            "slot": None,
            "rack": None,
        },
        "tags": tags,
    }
    return json.dumps({device: value}, indent=2) + "\n"


def _fuxa_type(entry: ExportEntry) -> str:
    point = entry.point
    if point.bit >= 0 or point.kind not in _FUXA_TYPES or point.order not in ("ABCD", "CDAB"):
        return ""
    if point.kind == "?" and entry.area.has_registers:
        return "UInt16"
    swapped = point.order == "CDAB" and point.registers > 1
    return _FUXA_TYPES[point.kind] + ("MLE" if swapped else "")


def _fuxa_tag(device: str, entry: ExportEntry) -> dict[str, Any]:
    point = entry.point
    tag: dict[str, Any] = {
        "id": f"t_{_id(device, entry.unique_name)}",
        "name": entry.unique_name,
        "label": entry.unique_name,
        "type": _fuxa_type(entry),
        "memaddress": _FUXA_AREAS[entry.area],
        "address": str(entry.one_based),
        "divisor": 1,
        "access": "",
        "options": "",
        "daq": {"enabled": False, "interval": 60, "changed": False},
    }
    if point.is_scaled:
        tag["scale"] = {
            "mode": "linear", "rawLow": 0, "rawHigh": 1000, "scaledLow": point.offset_eu,
            "scaledHigh": 1000 * point.scale + point.offset_eu,
        }  # fmt: skip
    return tag
