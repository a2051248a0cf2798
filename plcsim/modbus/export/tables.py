"""Tables for people and programs: CSV, JSON, Markdown."""

from __future__ import annotations

import csv
import io
import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from plcsim.modbus.export.entry import ExportEntry, MapExport


def _fields(entry: ExportEntry) -> dict[str, Any]:
    row, point = entry.row, entry.point
    return {
        "tag": row.tag,
        "area": point.area,
        "pdu_offset": point.offset,
        "one_based": entry.one_based,
        "modicon5": entry.modicon5,
        "modicon6": entry.modicon6,
        "ignition": entry.ignition,
        "registers": point.registers,
        "bit": None if point.bit < 0 else point.bit,
        "type": entry.type,
        "order": point.order,
        "access": point.access,
        "scale": point.scale,
        "offset_eu": point.offset_eu,
        "unit": row.unit,
        "min": point.minimum,
        "max": point.maximum,
        "group": row.group,
        "iec": row.iec,
        "description": row.description,
    }


def as_csv(export: MapExport) -> str:
    """Return one line for each tag, with all ways of counting."""
    out = io.StringIO()
    fields = [_fields(entry) for entry in export.entries]
    writer = csv.DictWriter(out, list(fields[0]) if fields else [], lineterminator="\n")
    writer.writeheader()
    writer.writerows(fields)
    return out.getvalue()


def as_json(export: MapExport) -> str:
    """Return the same as an object with a list of tags."""
    values = {
        "schema": "plcsim-tags/1",
        "project": export.project,
        "host": export.host,
        "port": export.port,
        "tags": [_fields(entry) for entry in export.entries],
    }
    return json.dumps(values, indent=2) + "\n"


_HEADINGS = ("tag", "area", "PDU offset", "Modicon", "type", "access", "unit", "description")


def as_markdown(export: MapExport) -> str:
    """Return a table for documentation."""
    lines = [f"| {' | '.join(_HEADINGS)} |", f"|{'---|' * len(_HEADINGS)}"]
    for entry in export.entries:
        point = entry.point
        offset = f"{point.offset}.{point.bit}" if point.bit >= 0 else str(point.offset)
        kind = entry.type
        if point.registers > 1 and point.kind != "s":
            kind = f"{kind} {point.order}"
        if point.is_scaled:
            kind += f" * {point.scale:g}"
        cells = (
            f"`{entry.row.tag}`", point.area, offset, entry.modicon6, kind, point.access,
            entry.row.unit, entry.row.description,
        )  # fmt: skip
        lines.append(f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |")
    return "\n".join(lines) + "\n"
