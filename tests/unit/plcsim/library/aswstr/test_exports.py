"""AsWStr has the functions of AsBrWStr under other names; those are tested there."""

from plcsim.library.asbrwstr.exports import EXPORTS as OF_ASBRWSTR
from plcsim.library.aswstr.exports import EXPORTS


def test_the_bodies_are_the_same():
    assert len(EXPORTS) == 11
    assert {f"br{name}": body for name, body in EXPORTS.items()} == OF_ASBRWSTR


def test_a_length(plc):
    assert plc.function("wcslen")(plc.bytes("käse".encode("utf-16-le") + bytes(2))) == 4
