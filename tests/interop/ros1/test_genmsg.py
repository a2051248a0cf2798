"""Our types against Debian's genmsg and genpy, type by type and byte by byte."""

import json
import random
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from crosnode.errors import MessageTypeError
from crosnode.messages import MessageType, MessageTypes, from_json
from crosnode.messages.definition import Field, integer_range
from crosnode.messages.packages import SHARE

PYTHON = "/usr/bin/python3"
DEBIAN = Path("/usr/share")


def ask(questions: list[list[str]]) -> list[Any]:
    text = "\n".join(map(json.dumps, questions))
    done = subprocess.run(
        [PYTHON, Path(__file__).with_name("genmsg_peer.py")],
        input=text, capture_output=True, text=True, check=True, timeout=60,
    )  # fmt: skip
    return [json.loads(line) for line in done.stdout.splitlines()]


def has_ros() -> bool:
    probe = [PYTHON, "-c", "import genpy, genmsg, roslib.message, geometry_msgs.msg"]
    try:
        return subprocess.run(probe, capture_output=True, check=False).returncode == 0
    except OSError:
        return False


pytestmark = pytest.mark.skipif(not has_ros(), reason="Debian's ROS 1 packages are not installed")


def installed(suffix: str) -> list[str]:
    """Return the types of our common packages that Debian has too, with their Python classes."""
    folders = [folder.name for folder in SHARE.iterdir()]
    known = ask([["has_classes", folder, suffix] for folder in folders])
    packages = [folder for folder, has_classes in zip(folders, known, strict=True) if has_classes]
    files = (f for p in packages for f in (DEBIAN / p / suffix).glob(f"*.{suffix}"))
    return sorted(f"{file.parts[-3]}/{file.stem}" for file in files)


@pytest.mark.parametrize("paths", [[], [DEBIAN]], ids=["common", "Debian's files"])
def test_md5_and_default_bytes_of_all_messages(paths: list[Path]) -> None:
    types, names = MessageTypes(paths), installed("msg")
    assert len(names) > 50
    for name, facts in zip(names, ask([["message_facts", name] for name in names]), strict=True):
        message_type = types.message(name)
        assert (name, message_type.md5sum) == (name, facts["md5"])
        assert (name, message_type.encode(message_type.new()).hex()) == (name, facts["default"])
        if paths:
            assert message_type.full_text.rstrip() == facts["text"].rstrip()


def test_md5_of_all_services() -> None:
    types, names = MessageTypes(), installed("srv")
    assert len(names) > 3
    for name, sums in zip(names, ask([["service_md5", name] for name in names]), strict=True):
        service = types.service(name)
        ours = [service.md5sum, service.request.md5sum, service.response.md5sum]
        assert (name, ours) == (name, sums)


class RandomValues:
    """Seeded values for messages, with the extremes of each type among them."""

    def __init__(self, types: MessageTypes, seed: int) -> None:
        self.types = types
        self.random = random.Random(seed)

    def message(self, message_type: MessageType) -> dict[str, Any]:
        return {field.name: self.field(field) for field in message_type.fields}

    def field(self, field: Field) -> Any:
        if not field.is_array:
            return self.element(field.base)
        count = self.random.randrange(4) if field.length is None else field.length
        return [self.element(field.base) for _ in range(count)]

    def element(self, base: str) -> Any:
        pick = self.random.choice
        if base in ("time", "duration"):
            low, high = integer_range("uint32" if base == "time" else "int32")
            return {"secs": pick([low, 0, high]), "nsecs": self.random.randrange(10**9)}
        if base == "string":
            return pick(["", "a", "é世界🤖", "nul\0in", "x" * 300])
        if base == "bool":
            return pick([True, False])
        if base.startswith("float"):
            return pick([0.0, -0.0, 1.5, "NaN", "Infinity", "-Infinity", 1e-38, -3e38])
        if "/" in base:
            return self.message(self.types.message(base))
        return pick([*integer_range(base), 0, 1])


@pytest.mark.parametrize("seed", range(3))
def test_random_bytes_are_read_and_written_alike(seed: int) -> None:
    types, names = MessageTypes(), installed("msg")
    values = RandomValues(types, seed)
    encoded = []
    for name in names:
        message_type = types.message(name)
        message = from_json(types, message_type, values.message(message_type))
        encoded.append(message_type.encode(message).hex())
    questions = [["reserialized", *pair] for pair in zip(names, encoded, strict=True)]
    assert ask(questions) == encoded


TYPES = [
    "int32",
    "string",
    "float64[]",
    "uint8[07]",
    "Name",
    "Header",
    "other/Name[2]",
    "time",
    "x y",
]
NAMES = [" a", "  b ", "\tc", " D", " kFoo ", " 1x", ""]
VALUES = ["", "=1", " = 007", "=1e-3", "= a # b", "=a=b", "=True", "=-5 # five", "=999999999999"]
ENDS = ["", " ", "\t# tail", " # x=y", "\r"]


def random_texts() -> Iterator[str]:
    pick = random.Random(1).choice
    for _ in range(2000):
        yield "\n".join(
            pick(["", " ", "# c", "---"]) + pick(TYPES) + pick(NAMES) + pick(VALUES) + pick(ENDS)
            for _ in range(pick([1, 1, 2]))
        )


def our_md5(text: str) -> str | None:
    types = MessageTypes()
    types.define("other/Name", "string data")
    try:
        return types.define("pkg/Type", text).md5sum
    except MessageTypeError:
        return None


def test_any_definition_has_genmsg_s_md5_or_is_refused_by_both() -> None:
    texts = list(random_texts())
    answers = ask([["md5_of_text", text.replace("\r\n", "\n")] for text in texts])
    assert sum(answer is not None for answer in answers) > 200
    different = [
        (text, ours, theirs)
        for text, theirs in zip(texts, answers, strict=True)
        if (ours := our_md5(text)) != theirs
    ]
    assert different == []
