"""Values are kept for a bounded number of interfaces."""

from plcsim.library.asarcfg.configuration import MOST_INTERFACES, ArConfiguration, Text


def test_texts_have_an_end():
    found = ArConfiguration(None)
    names = [f"IF{number}" for number in range(MOST_INTERFACES * len(Text) + 1)]
    assert [found.set_text(name, Text.IP, "10.0.0.1") for name in names].count(False) == 1
    assert found.set_text("IF0", Text.IP, "10.0.0.2")
    assert found.text("IF0", Text.IP) == "10.0.0.2"
    assert found.text(names[-1], Text.IP) == Text.IP.value


def test_modes_have_an_end():
    found = ArConfiguration(None)
    assert [found.set_mode(f"IF{n}", 1) for n in range(MOST_INTERFACES + 1)].count(False) == 1
    assert found.set_mode("IF0", 0)
    assert found.mode("IF1") == 1
    assert found.mode("other") == 0
