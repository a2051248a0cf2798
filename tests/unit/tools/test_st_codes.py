"""The page of codes of Structured Text from the table in the code."""

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import pytest

from plcsim.program.structured_text.codes import EXPLANATIONS, FindingCode

TOP = Path(__file__).parents[3]
FINDINGS = TOP / "tests" / "corpus" / "structured_text"


@pytest.fixture(scope="module")
def tool():
    """The module, loaded from its file: tools/ is no package."""
    spec = spec_from_file_location("st_codes", TOP / "tools" / "st_codes.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_is_as_the_table_is(tool):
    assert tool.PAGE.read_text("utf-8") == tool.page()  # else: python tools/st_codes.py


def test_every_code_is_explained_in_order():
    assert list(EXPLANATIONS) == list(FindingCode)
    assert [*FindingCode] == sorted(FindingCode)


def test_every_code_is_told_by_a_case():
    told = "".join(file.read_text("utf-8") for file in FINDINGS.glob("*findings.txt"))
    elsewhere = {FindingCode.SYNTAX, FindingCode.UNUSED_VARIABLE}
    assert {code for code in FindingCode if code.value not in told} == elsewhere
