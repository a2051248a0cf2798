"""Cases in files: a text and what is expected of it, so that neither needs quotes."""

import re
from pathlib import Path

FOLDER = Path(__file__).parents[4] / "corpus" / "structured_text"


def cases(name: str) -> list[tuple[str, str]]:
    """Texts and expectations of a file, cut by lines of ``====`` and ``----``.

    Behind ``====`` may stand what the case is about.
    """
    found = []
    for case in re.split(r"^====.*\n", (FOLDER / name).read_text("utf-8"), flags=re.MULTILINE)[1:]:
        text, _, expected = case.partition("\n----\n")
        found.append((text, expected.rstrip("\n")))
    assert found, name
    return found
