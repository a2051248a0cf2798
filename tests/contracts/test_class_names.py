"""One name, one thing: public classes of the three packages do not share names."""

import ast
from collections import defaultdict
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]

STAGES = frozenset(
    [
        "st_types/syntax/expressions.py",
        "st_types/syntax/literals.py",
        "plcsim/program/structured_text/syntax/tree.py",
        "plcsim/program/structured_text/check/typed.py",
        "plcsim/program/structured_text/ir.py",
    ]
)
"""The stages of the compiler use the words of the language, each for the same piece of a program:
an IF as it is written (``tree.If``), as it is checked (``typed.If``), as it runs (``ir.If``)."""

ACCEPTED = {
    "Address": "of a host, in network; the compiler's is typed.Address, what ADR() gives",
    "Configuration": "the norm's CONFIGURATION (tree.Configuration), and Automation Studio's",
    "Duration": "ROS 1's word for its own type; in plcsim.settings, a kind of setting",
    "Frame": "of a call chain in the machine; in crosnode.tf, ROS's word for a coordinate frame",
    "Member": "of a STRUCT in st_types; typed.Member is the access to one",
    "MethodCall": "XML-RPC's own word; typed.MethodCall is a call of a METHOD",
    "Signature": "of a WebAssembly function in the machine; ir.Signature before it is encoded",
    "Store": "WebAssembly's word for what owns instances; ir.Store is the instruction",
}
"""Names that two things have because each is its field's word."""


@cache
def places():
    """Where each public class is defined; generated faces of libraries are left out."""
    found = defaultdict(set)
    for package in ("st_types", "plcsim", "crosnode"):
        for file in (ROOT / package).rglob("*.py"):
            if file.name != "interface.py":
                for node in ast.walk(ast.parse(file.read_text("utf-8"))):
                    if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                        found[node.name].add(str(file.relative_to(ROOT)))
    return found


def test_a_name_stands_for_one_thing():
    shared = {name: files for name, files in places().items() if len(files) > 1}
    confused = {n: f for n, f in shared.items() if n not in ACCEPTED and not f <= STAGES}
    assert not confused, "give each its field's word, or a reason in ACCEPTED"


def test_what_is_accepted_is_needed():
    assert {name for name in ACCEPTED if len(places()[name]) < 2} == set()
