"""Structures lie in a unit as gcc -m32 lays them out: offsets, sizes and every bit-field's bits."""

import random

import pytest

IEC = {
    "BOOL": "unsigned char",
    "SINT": "signed char",
    "USINT": "unsigned char",
    "INT": "signed short",
    "UINT": "unsigned short",
    "DINT": "signed long",
    "UDINT": "unsigned long",
    "REAL": "float",
    "LREAL": "double",
    "LINT": "signed long long",
    "ULINT": "unsigned long long",
    "TIME": "signed long",
    "DATE_AND_TIME": "unsigned long",
    "WCHAR_": "unsigned short",
}
HOST = "".join(f"typedef {c} {name};\n" for name, c in IEC.items())
UNIT = "#include <bur/plctypes.h>\ntypedef unsigned short WCHAR_;\n"
BASE = "#include <stddef.h>\n#include <string.h>\nenum Mode { OFF, ON = 5 };\n"
OTHERS = ("char", "short", "int", "long", "void *", "enum Mode", "size_t", "wchar_t")
STRUCTURES = 60
SEEDS = range(4)


def members(chance, earlier):
    """Return members of a structure as (name, declaration, width of a bit-field or 0)."""
    for number in range(chance.randint(1, 9)):
        name = f"m{number}"
        kind = chance.randrange(8)
        if kind == 0:
            base = chance.choice(("unsigned", "int", "unsigned char", "unsigned short", "UDINT"))
            most = {"unsigned char": 8, "unsigned short": 16}.get(base, 32)
            width = chance.randint(1, most)
            yield name, f"{base} {name} : {width}", width
        elif kind == 1 and earlier:
            yield name, f"struct {chance.choice(earlier)} {name}", 0
        elif kind == 2:
            yield name, f"{chance.choice([*IEC])} {name}[{chance.randint(1, 5)}]", 0
        elif kind == 3:
            yield name, f"{chance.choice(OTHERS)} {name}", 0
        else:
            yield name, f"{chance.choice([*IEC])} {name}", 0


def table(seed):
    """Return C that writes a table of layouts, and how many numbers that are."""
    chance = random.Random(seed)
    types, lines, earlier, count = "", "", [], 0
    for number in range(STRUCTURES):
        found = [*members(chance, earlier)]
        kind = chance.choice(("struct", "struct", "struct", "union"))
        name = f"S{number}"
        types += f"{kind} {name} {{ " + " ".join(f"{text};" for _, text, _ in found) + " };\n"
        lines += f"\t*to++ = sizeof({kind} {name});\n"
        count += 1
        for member, _, width in found:
            if width:
                lines += f"\t{{ {kind} {name} x; memset(&x, 0, sizeof x); x.{member} = -1;\n"
                lines += "\tto = bits(to, &x, sizeof x); }\n"
                count += 2
            else:
                lines += f"\t*to++ = offsetof({kind} {name}, {member});\n"
                count += 1
        if kind == "struct":
            earlier.append(name)
    helper = (
        "static unsigned *bits(unsigned *to, void *area, unsigned size)\n{\n"
        "\tunsigned sum = 0, first = 0;\n"
        "\tfor (unsigned i = size; i--;)\n"
        "\t\tif (((unsigned char *)area)[i])\n"
        "\t\t\tfirst = i, sum = sum * 31 + ((unsigned char *)area)[i];\n"
        "\t*to++ = first;\n\t*to++ = sum;\n\treturn to;\n}\n"
    )
    return f"{BASE}{types}{helper}void fill(unsigned *to)\n{{\n{lines}}}\n", count


@pytest.mark.parametrize("seed", SEEDS)
def test_every_offset_is_that_of_gcc(seed, unit_results, host_results):
    text, count = table(seed)
    assert count > 3 * STRUCTURES
    host = host_results(HOST + text, count)
    assert unit_results(UNIT + text, count) == host
