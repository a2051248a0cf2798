"""Files as clang reads them where it would refuse, or take for something else, what GCC takes.

The compiler finds the changed text under the name of the file, by an overlay; lines stay where they
are, so that what it tells has its place.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from plcsim.ansi_c.inline_assembly import without_rdtsc

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path


class Rewriting:
    """The changed texts of one source and of the headers that it reads.

    Args:
        source: the file that is compiled.
        file: gives the name of a file of its own for what is written; its suffix is replaced.
    """

    def __init__(self, source: Path, file: Callable[[], Path]) -> None:
        self._file = file
        self._texts: dict[Path, bytes] = {}
        if b"rdtsc" in (text := self.text(source)):
            self.put(source, without_rdtsc(text))

    def text(self, file: Path) -> bytes:
        """Return the text of a file as it is read now; nothing where there is none."""
        try:
            return self._texts[file] if file in self._texts else file.read_bytes()
        except OSError:  # the compiler will tell
            return b""

    def line(self, file: Path, number: int) -> bytes:
        """Return a line of a file as it is read now, from 1 on; nothing where there is none."""
        lines = self.text(file).split(b"\n")
        return lines[number - 1] if 0 < number <= len(lines) else b""

    def put_line(self, file: Path, number: int, text: bytes) -> bool:
        """Let a line be read as another text; return whether that is a change."""
        lines = self.text(file).split(b"\n")
        lines[number - 1] = text
        return self.put(file, b"\n".join(lines))

    def put(self, file: Path, text: bytes) -> bool:
        """Let a file be read as another text; return whether that is a change."""
        is_new = text != self.text(file)
        if is_new:
            self._texts[file] = text
        return is_new

    def options(self) -> list[str]:
        """Return the options by which the compiler reads the texts."""
        if not self._texts:
            return []
        overlay = self._file().with_suffix(".overlay")
        roots = []
        for number, (file, text) in enumerate(self._texts.items()):
            copy = overlay.with_suffix(f".{number}{file.suffix}")
            copy.write_bytes(text)
            entry = {"type": "file", "name": file.name, "external-contents": str(copy)}
            roots.append({"type": "directory", "name": str(file.parent), "contents": [entry]})
        shape = {"version": 0, "case-sensitive": "false", "use-external-names": "false"}
        overlay.write_text(json.dumps({**shape, "roots": roots}))
        return ["-Xclang", "-ivfsoverlay", "-Xclang", str(overlay)]
