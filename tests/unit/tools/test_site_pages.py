"""The site of the documentation: pages made from the code, and a navigation that misses none."""

import re
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import pytest

TOP = Path(__file__).parents[3]
NAME = "site_pages"


@pytest.fixture(scope="module")
def tool():
    """The module, loaded from its file: tools/ is no package."""
    spec = spec_from_file_location(NAME, TOP / "tools" / f"{NAME}.py")
    module = module_from_spec(spec)
    sys.modules[NAME] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[NAME]


def test_every_page_is_in_the_navigation(tool):
    named = set(re.findall(r"^ +- ([\w/-]+\.md)$", (TOP / "mkdocs.yml").read_text(), re.MULTILINE))
    pages = {str(p.relative_to(TOP / "docs")) for p in (TOP / "docs").rglob("*.md")}
    made = {path for path, _ in tool.pages()}
    listed = {page for page in pages | made if not page.startswith(("decisions/", "api/"))}
    assert listed - {"index.md", "changelog.md"} == named - {"index.md", "changelog.md"}


def test_empty_sections_are_filled(tool):
    nav = ["index.md", {"Understand": ["a.md", {"Decisions": []}]}, {"API": []}]
    index, understand, api = tool.on_config({"nav": nav})["nav"]
    assert index == "index.md"
    assert understand["Understand"][1]["Decisions"][0] == "decisions/index.md"
    assert len(understand["Understand"][1]["Decisions"]) > 5
    assert [list(section) for section in api["API"]] == [["plcsim"], ["st_types"], ["crosnode"]]
    assert "api/plcsim.testing.md" in api["API"][0]["plcsim"]


def test_the_home_page_is_the_readme_with_links_that_lead_somewhere(tool):
    home = dict(tool.pages())["index.md"]
    targets = re.findall(r"\]\(([^)#]+)\)", home)
    assert "project.md" in targets
    pages = {str(p.relative_to(TOP / "docs")) for p in (TOP / "docs").rglob("*.*")}
    pages |= {path for path, _ in tool.pages()}
    assert {target for target in targets if "://" not in target} <= pages


def test_commands_are_shown_as_they_print_their_help(tool):
    page = tool.commands()
    assert "\n## plcsim run\n" in page
    assert "usage: plcsim types check " in page


def test_every_decision_is_listed_by_its_title(tool):
    assert "- [4. The watchdog is the parent process](0004-the-watchdog-is-the-parent.md)" in (
        tool.decisions()
    )


def test_the_api_of_a_room_has_its_modules(tool):
    assert tool.api("plcsim.host").splitlines()[:4] == [
        "# plcsim.host", "", "::: plcsim.host", ""
    ]  # fmt: skip
    assert "::: plcsim.host.processors\n" in tool.api("plcsim.host")
    assert "__main__" not in tool.api("plcsim")


@pytest.mark.parametrize(
    ("path", "text", "shown"),
    [
        ("a.md", "see [tank](../programs/tank).", "see tank."),
        ("guide/a.md", "[tank](../../programs/tank)", "tank"),
        ("guide/a.md", "[b](../b.md#x) and [c](c.md)", "[b](../b.md#x) and [c](c.md)"),
        ("a.md", "![picture](../images/x.png)", "![picture](../images/x.png)"),
    ],
)
def test_links_out_of_the_site_are_their_text_alone(tool, path, text, shown):
    assert tool.inside(text, path) == shown
