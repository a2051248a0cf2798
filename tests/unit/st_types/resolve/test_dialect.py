from st_types.resolve.dialect import AUTOMATION_STUDIO, IEC, Dialect
from st_types.types.elementary import INT, TIME_OF_DAY


def test_case_of_names() -> None:
    assert AUTOMATION_STUDIO.key("Speed") == "Speed"
    assert IEC.key("Speed") == IEC.key("SPEED")


def test_keywords_of_types_in_the_usual_spellings() -> None:
    types = Dialect("short", case_sensitive=True, string_length=5).simple_types
    assert types["INT"] is types["int"] is INT
    assert types["TOD"] is TIME_OF_DAY
    assert (types["STRING"].name, types["wstring"].name) == ("STRING[5]", "WSTRING[5]")
