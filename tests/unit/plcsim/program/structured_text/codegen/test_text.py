"""The code of a module as text."""

from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.codegen.text import text_of

from ..running import Running


def test_addresses_and_lines_stand_beside_what_they_belong_to():
    lines = ["VAR a, b : INT; END_VAR", "IF a = 1 THEN", "b := 2;", "END_IF", "a := 3;"]
    text = "\n".join(["PROGRAM _CYCLIC", *lines, "END_PROGRAM"])
    running = Running(text)
    notes = [line.partition("  ;; ")[2] for line in text_of(generate(running.module))]
    running.close()
    assert list(filter(None, notes)) == [
        "program 1+0  a.st:3",
        "program 1+2  line 4",
        "program 1+0  line 6",
    ]
