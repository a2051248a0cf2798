"""Configurations of modpoll, Telegraf, Kepware and Ignition.

Those of Kepware and Ignition follow their documentation; no installation was at hand to try them.
"""

from __future__ import annotations

import csv
import io
import json
from typing import TYPE_CHECKING, Any

from plcsim.modbus.export.entry import extent
from plcsim.modbus.map.point import Area

if TYPE_CHECKING:
    from plcsim.modbus.export.entry import ExportEntry, MapExport

_MODPOLL_AREAS = {
    Area.COILS: "coil",
    Area.DISCRETE_INPUTS: "discrete_input",
    Area.INPUT_REGISTERS: "input_register",
    Area.HOLDING_REGISTERS: "holding_register",
}
_MODPOLL_ORDERS = {"ABCD": "BE_BE", "CDAB": "BE_LE", "BADC": "LE_BE", "DCBA": "LE_LE"}


def _lines(rows: list[list[Any]]) -> str:
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    return out.getvalue()


def modpoll(export: MapExport) -> str:
    """Return the CSV of modpoll (gavinying/modpoll): a poll for each block and word order."""
    rows: list[list[Any]] = [["device", export.project, 1]]
    for area, name in _MODPOLL_AREAS.items():
        for order, endian in _MODPOLL_ORDERS.items():
            same = [e for e in export.of(area) if e.point.order == order and e.point.bit < 0]
            if not same:
                continue
            first, count = extent(same)
            rows.append(["poll", name, first, count, endian])
            if area.has_registers:
                rows += [_modpoll_ref(entry) for entry in same]
            else:
                rows += _modpoll_bits(area, first, count)
    return _lines(rows)


def _modpoll_bits(area: Area, first: int, count: int) -> list[list[Any]]:
    """Return references to eight bits each; modpoll knows no smaller ones."""
    access = "rw" if area.is_writable else "r"
    return [
        [
            "ref",
            f"{area.value}{start}_to_{min(start + 8, first + count) - 1}",
            start,
            "bool8",
            access,
        ]
        for start in range(first, first + count, 8)
    ]


def _modpoll_ref(entry: ExportEntry) -> list[Any]:
    point = entry.point
    kind = f"string{2 * point.registers}" if point.kind == "s" else entry.type
    if point.kind == "?":
        kind = "uint16"
    access = "rw" if point.is_writable else "r"
    return ["ref", entry.unique_name, point.offset, kind, access, entry.row.unit, point.scale]


_TELEGRAF_AREAS = {
    Area.COILS: "coil",
    Area.DISCRETE_INPUTS: "discrete",
    Area.INPUT_REGISTERS: "input",
    Area.HOLDING_REGISTERS: "holding",
}


def telegraf(export: MapExport) -> str:
    """Return an input of Telegraf's Modbus plugin in its "request" style."""
    lines = [
        "[[inputs.modbus]]",
        f"  name = {json.dumps(export.project)}",
        f'  controller = "tcp://{export.host}:{export.port}"',
        '  configuration_type = "request"',
    ]
    for area, name in _TELEGRAF_AREAS.items():
        for order in ("ABCD", "CDAB", "BADC", "DCBA"):
            same = [e for e in export.of(area) if e.point.order == order]
            if same:
                lines += [
                    "",
                    "  [[inputs.modbus.request]]",
                    "    slave_id = 1",
                    f'    byte_order = "{order}"',
                    f'    register = "{name}"',
                    "    fields = [",
                    *(f"      {_telegraf_field(entry)}," for entry in same),
                    "    ]",
                ]
    return "\n".join(lines) + "\n"


def _telegraf_field(entry: ExportEntry) -> str:
    point = entry.point
    parts = [f"address = {point.offset}", f"name = {json.dumps(entry.unique_name)}"]
    if entry.area.has_registers:
        kind = entry.type.upper()
        if point.bit >= 0:
            kind = "BIT"
            parts.append(f"bit = {point.bit}")
        elif point.kind == "?":
            kind = "UINT16"
        elif point.kind == "s":
            parts.append(f"length = {point.registers}")
        parts.append(f'type = "{kind}"')
        if point.is_scaled:
            parts.append(f"scale = {point.scale!r}")
            parts.append('output = "FLOAT64"')
    return "{ " + ", ".join(parts) + " }"


_KEPWARE_COLUMNS = (
    "Tag Name", "Address", "Data Type", "Respect Data Type", "Client Access", "Scan Rate",
    "Scaling", "Raw Low", "Raw High", "Scaled Low", "Scaled High", "Scaled Data Type",
    "Clamp Low", "Clamp High", "Eng Units", "Description", "Negate Value",
)  # fmt: skip
_KEPWARE_TYPES = {
    "?": "Boolean", "h": "Short", "H": "Word", "i": "Long", "I": "DWord", "q": "LLong",
    "Q": "QWord", "f": "Float", "d": "Double", "s": "String",
}  # fmt: skip


def kepware(export: MapExport) -> str:
    """Return the tags of a Modbus device in Kepware's CSV, with six-digit addresses."""
    rows: list[list[Any]] = [list(_KEPWARE_COLUMNS)]
    for entry in export.entries:
        point = entry.point
        address = entry.modicon6
        kind = _KEPWARE_TYPES[point.kind]
        if point.bit >= 0:
            address += f".{point.bit:02d}"
        elif point.kind == "?" and entry.area.has_registers:
            kind = "Word"
        elif point.kind == "s":
            address += f".{2 * point.registers}H"
        access = "R/W" if point.is_writable else "RO"
        scaling: list[Any] = ["", "", "", "", "", ""]
        if point.is_scaled:
            high = 1000 * point.scale + point.offset_eu
            scaling = ["Linear", 0, 1000, point.offset_eu, high, "Double"]
        rows.append(
            [entry.unique_name, address, kind, 1, access, 100, *scaling, "", "",
             entry.row.unit, entry.row.description, ""]
        )  # fmt: skip
    return _lines(rows)


_IGNITION_TYPES = {
    "?": "Boolean", "h": "Int2", "H": "Int4", "i": "Int4", "I": "Int8", "q": "Int8", "Q": "Int8",
    "f": "Float4", "d": "Float8", "s": "String",
}  # fmt: skip


def ignition(export: MapExport) -> str:
    """Return OPC tags as Ignition's tag import takes them; the device is called like the project.

    The word order is a setting of the device there: "Reverse Numeric Word Order" for CDAB.
    """
    tags = [
        {
            "name": entry.unique_name,
            "tagType": "AtomicTag",
            "valueSource": "opc",
            "opcServer": "Ignition OPC UA Server",
            "opcItemPath": f"ns=1;s=[{export.project}]{entry.ignition}",
            "dataType": _IGNITION_TYPES[entry.point.kind],
            "readOnly": not entry.point.is_writable,
            "engUnit": entry.row.unit,
            "documentation": entry.row.description,
        }
        for entry in export.entries
    ]
    return json.dumps({"name": export.project, "tagType": "Folder", "tags": tags}, indent=2) + "\n"
