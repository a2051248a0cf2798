"""Tags of every cycle as a table of Parquet, for notebooks."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, Any, Final

from plcsim.recorder.errors import RecordingError
from st_types.types.elementary import ElementaryType
from st_types.types.values import decode

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from plcsim.core.tag import Tag
    from st_types.types.elementary import DataType

FIXED: Final = ("double", "int64", "int64")
"""Types of the columns time_s, task_class and cycle."""

ROWS: Final = 50_000
"""Rows that are in memory at once."""


def write_parquet(path: Path, tags: Sequence[Tag], rows: Iterator[list[Any]]) -> None:
    """Write rows with the types of their tags.

    Args:
        path: of the file.
        tags: of the columns behind `FIXED`.
        rows: as of `plcsim.recorder.bag.series.rows_of`, the names of the columns first.

    Raises:
        RecordingError: pyarrow is not installed, or the file cannot be written.
    """
    try:
        import pyarrow as pa  # noqa: PLC0415  # an extra
        from pyarrow import parquet  # noqa: PLC0415
    except ImportError:
        raise RecordingError(
            "Parquet needs the package pyarrow: pip install 'plcsim[parquet]'"
        ) from None
    types = [*FIXED, *(_type(tag.data_type) for tag in tags)]
    names = next(rows)
    schema = pa.schema([(n, pa.type_for_alias(t)) for n, t in zip(names, types, strict=True)])
    try:
        with parquet.ParquetWriter(path, schema) as writer:
            while part := list(islice(rows, ROWS)):
                columns = map(pa.array, zip(*part, strict=True), schema.types)
                writer.write_table(pa.Table.from_arrays(list(columns), schema=schema))
    except OSError as err:
        raise RecordingError(f"{path}: cannot be written: {err}") from None


def _type(kind: DataType[Any]) -> str:
    """Return pyarrow's name for the Python values of a type."""
    value = decode(kind, bytes(kind.size))
    if isinstance(value, bool | str):
        return type(value).__name__.replace("str", "string")
    if isinstance(value, float):
        return "double"
    return "uint64" if isinstance(kind, ElementaryType) and kind.code == "Q" else "int64"
