"""Cases in files: a text and what is expected of it, so that neither needs quotes."""

from pathlib import Path

FOLDER = Path(__file__).parents[4] / "corpus" / "structured_text"


def cases(name: str) -> list[tuple[str, str]]:
    """Texts and expectations of a file, cut by lines of ``====`` and ``----``."""
    found = []
    for case in (FOLDER / name).read_text("utf-8").split("====\n")[1:]:
        text, _, expected = case.partition("\n----\n")
        found.append((text, expected.rstrip("\n")))
    assert found, name
    return found
