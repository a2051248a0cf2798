"""Text that came from somewhere else, made fit to be shown."""

import unicodedata

import pytest

from plcsim.core.text import escaped


def test_ordinary_text_stays_as_it_is():
    text = "Füllstand 3 °C\n\tpumpe läuft, 水 🙂"
    assert escaped(text) == text


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("\x1b[2Jgone", "\\x1b[2Jgone"),
        ("\x9b2Jgone", "\\x9b2Jgone"),
        ("a\rb\x07\x00\x7f", "a\\x0db\\x07\\x00\\x7f"),
        ("\u202egnp.exe", "\\u202egnp.exe"),
        ("a\u2028b", "a\\u2028b"),
    ],
)
def test_what_a_terminal_would_act_on_is_a_number(text, shown):
    assert escaped(text) == shown


def test_of_all_control_characters_only_tab_and_line_feed_stay():
    controls = [chr(code) for code in range(0x110000) if unicodedata.category(chr(code)) == "Cc"]
    assert [c for c in controls if escaped(c) == c] == ["\t", "\n"]
