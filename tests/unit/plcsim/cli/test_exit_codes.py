"""What the exit codes mean, in every help and in the docs."""

from pathlib import Path

import pytest

from plcsim.cli.exit_codes import MEANINGS, ExitCode, epilog

README = Path(__file__).parents[4] / "README.md"


def test_a_command_tells_its_codes_in_order():
    assert epilog(SERVICE="", DONE="ran") == (
        "Exit codes: 0 ran, 3 the controller ended in SERVICE."
    )


@pytest.mark.parametrize("code", ExitCode)
def test_every_code_has_a_meaning_that_the_readme_tells(code):
    text = " ".join(README.read_text("utf-8").split())
    assert f"{code.value} {MEANINGS[code]}" in text.partition("Exit codes of `plcsim`:")[2]
