"""Results on disk: Parquet, written as they come, so that an interrupted campaign goes on.

A folder of results holds ``campaign.json`` with what it is of, ``part-*.parquet`` while the
campaign runs, and ``results.parquet`` once it is complete. Columns: ``number``, ``seed``,
``outcome``, ``cause``, ``message``, ``margin``, ``host_s``, a column for each variable, and
``measured NAME`` for each that is measured.
"""

from __future__ import annotations

import json
import shutil
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, Final

import pyarrow as pa
from pyarrow import parquet

from plcsim.campaign.errors import CampaignError
from plcsim.campaign.result import PlannedRun, Result, RunOutcome

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from plcsim.campaign.variables import Scalar

ABOUT_FILE: Final = "campaign.json"
RESULTS_FILE: Final = "results.parquet"

VALUE: Final = "value "
MEASURED: Final = "measured "
"""How the names of columns begin, so that no tag is mistaken for a column of our own."""

OWN_COLUMNS: Final = ("number", "seed", "outcome", "requirement", "message", "margin", "host_s")

_BATCH = 500


@dataclass(frozen=True)
class About:
    """What results are of.

    Attributes:
        file: of the campaign, as it was named.
        content: name of the content (`plcsim.campaign.content`).
        runs: planned.
        version: of plcsim.
    """

    file: str
    content: str
    runs: int
    version: str


class ResultStore:
    """A folder of results.

    Args:
        folder: is made where it is not there.
        about: the campaign that is to be done.
        fresh: remove what is there.

    Raises:
        CampaignError: the folder holds results of something else, or cannot be written.
    """

    def __init__(self, folder: Path, about: About, *, fresh: bool = False) -> None:
        self._folder = folder
        self._waiting: list[Result] = []
        if fresh and (folder / ABOUT_FILE).is_file():
            shutil.rmtree(folder)
        self._open(about)
        self._parts = sorted(folder.glob("part-*.parquet"))
        self.done = {n for file in self._files() for n in _numbers(file)}

    def _open(self, about: About) -> None:
        file = self._folder / ABOUT_FILE
        if file.is_file():
            before = read_about(self._folder)
            if before != about:
                raise CampaignError(
                    f"{self._folder}: holds results of {_difference(before, about)}; "
                    "--fresh begins again, --output names another folder"
                )
            return
        if self._folder.is_dir() and any(self._folder.iterdir()):
            raise CampaignError(f"{self._folder}: is a folder with other files in it")
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            file.write_text(json.dumps(asdict(about), indent=2) + "\n", "utf-8")
        except OSError as err:
            raise CampaignError(f"{self._folder}: cannot be written: {err.strerror}") from None

    def _files(self) -> list[Path]:
        whole = self._folder / RESULTS_FILE
        return [whole, *self._parts] if whole.is_file() else self._parts

    def add(self, result: Result) -> None:
        """Take a result; it is on disk after `flush`, or with enough others."""
        self._waiting.append(result)
        self.done.add(result.order.number)
        if len(self._waiting) >= _BATCH:
            self.flush()

    def flush(self) -> None:
        """Write what is waiting."""
        if not self._waiting:
            return
        number = int(self._parts[-1].stem.partition("-")[2]) + 1 if self._parts else 0
        file = self._folder / f"part-{number:06}.parquet"
        write_results(file, self._waiting)
        self._parts.append(file)
        self._waiting = []

    def complete(self) -> None:
        """Make one file of all parts, in the order of the numbers."""
        self.flush()
        if self._parts:
            table = pa.concat_tables(
                [parquet.read_table(file) for file in self._files()], promote_options="permissive"
            )
            _write(self._folder / RESULTS_FILE, table.sort_by("number"))
        for part in self._parts:
            part.unlink()
        self._parts = []

    def results(self) -> Iterator[Result]:
        """Yield all results on disk, in no order."""
        for file in self._files():
            yield from read_results(file)


def read_about(folder: Path) -> About:
    """Return what the results in a folder are of.

    Raises:
        CampaignError: there are none.
    """
    try:
        return About(**json.loads((folder / ABOUT_FILE).read_text("utf-8")))
    except FileNotFoundError:
        raise CampaignError(f"{folder}: holds no results of a campaign") from None
    except (OSError, ValueError, TypeError) as err:
        raise CampaignError(f"{folder / ABOUT_FILE}: cannot be read: {err}") from None


def _difference(before: About, now: About) -> str:
    if before.file != now.file:
        return before.file
    if before.version != now.version:
        return f"plcsim {before.version}"
    return f"{before.file} as it was before it, the project or its libraries were changed"


def write_results(file: Path, results: Iterable[Result]) -> None:
    """Write a file of results.

    Raises:
        CampaignError: one name holds texts in one run and numbers in another.
    """
    rows = [_row(result) for result in results]
    names = dict.fromkeys(name for row in rows for name in row)
    columns = {}
    for name in names:
        cells = [row.get(name) for row in rows]
        try:
            columns[name] = pa.array(_unified(cells))
        except (pa.ArrowInvalid, pa.ArrowTypeError, OverflowError):
            raise CampaignError(f"{name}: has values of several kinds") from None
    _write(file, pa.table(columns))


def _unified(cells: list[Any]) -> list[Any]:
    """Return cells with every number a float where one of them is."""
    if any(isinstance(cell, float) for cell in cells):
        return [float(c) if type(c) is int else c for c in cells]
    return cells


def _write(file: Path, table: pa.Table) -> None:
    beside = file.with_suffix(".writing")
    parquet.write_table(table, beside)
    beside.replace(file)


def _row(result: Result) -> dict[str, Scalar | None]:
    order = result.order
    own: dict[str, Scalar | None] = {
        "number": order.number,
        "seed": order.seed,
        "outcome": str(result.outcome),
        "requirement": result.requirement,
        "message": result.message,
        "margin": result.margin,
        "host_s": result.host_s,
    }
    values = {VALUE + name: value for name, value in order.values.items()}
    return own | values | {MEASURED + name: value for name, value in result.measured.items()}


def read_results(file: Path) -> Iterator[Result]:
    """Yield the results in a file.

    Raises:
        CampaignError: it is no file of results.
    """
    try:
        with parquet.ParquetFile(file) as opened:
            for batch in opened.iter_batches():
                yield from (_result(row) for row in batch.to_pylist())
    except (OSError, pa.ArrowException, KeyError, ValueError) as err:
        raise CampaignError(f"{file}: cannot be read: {err}") from None


def _result(row: dict[str, Any]) -> Result:
    def named(prefix: str) -> dict[str, Any]:
        found = {k.removeprefix(prefix): v for k, v in row.items() if k.startswith(prefix)}
        return {name: value for name, value in found.items() if value is not None}

    return Result(
        PlannedRun(row["number"], row["seed"], named(VALUE)),
        RunOutcome(row["outcome"]),
        row["message"],
        row["requirement"],
        row["margin"],
        named(MEASURED),
        row["host_s"],
    )


def _numbers(file: Path) -> list[int]:
    try:
        numbers: list[int] = parquet.read_table(file, columns=["number"])["number"].to_pylist()
    except (OSError, pa.ArrowException) as err:
        raise CampaignError(f"{file}: cannot be read: {err}") from None
    return numbers


def read_folder(folder: Path) -> tuple[About, list[Result]]:
    """Return what the results in a folder are of, and the results in the order of their numbers.

    Raises:
        CampaignError: there are none, or they cannot be read.
    """
    about = read_about(folder)
    files = [f for f in (folder / RESULTS_FILE, *folder.glob("part-*.parquet")) if f.is_file()]
    found = {result.order.number: result for file in files for result in read_results(file)}
    return about, [found[number] for number in sorted(found)]


class Examples:
    """The smallest failing examples, kept beside the results.

    Args:
        folder: of the results.
        content: name of the content they belong to; others are forgotten.
    """

    def __init__(self, folder: Path, content: str) -> None:
        self._file = folder / f"smallest-{content}.parquet"
        known = read_results(self._file) if self._file.is_file() else ()
        self._found = {result.cause: result for result in known}

    def get(self, cause: str) -> Result | None:
        """Return the smallest example of a cause, None where nobody has looked for it."""
        return self._found.get(cause)

    def keep(self, example: Result) -> None:
        """Keep the smallest example of its cause."""
        self._found[example.cause] = example
        write_results(self._file, self._found.values())
