"""Random programs in Structured Text with their declarations, each with its translation to C.

A program has variables of all elementary types, arrays of one and two dimensions, structures in
arrays and in structures, strings, references, functions, function blocks in function blocks, and
actions. In C its variables lie at the addresses that they have in PLC memory.
"""

import random
from typing import NamedTuple

from .random_st import COLOURS, INTEGERS, TYPES, Body, at, join

BASE = 0x120000
"""Address of the variables."""

LOOPS = 40
HEAD = """
#include <math.h>
#include <stdint.h>
#include <string.h>
static void string_assign(char *target, const char *source, int limit) {
    int i;
    for (i = 0; i < limit && source[i] != 0; i++) target[i] = source[i];
    target[i] = 0;
}
static int string_order(const char *a, const char *b) {
    while (*a && *a == *b) a++, b++;
    return (int)(unsigned char)*a - (int)(unsigned char)*b;
}
"""


class Layout(NamedTuple):
    """A type: its name, its size, and its elementary parts as (path, offset, type)."""

    name: str
    size: int
    alignment: int
    parts: list


def elementary(name):
    size = TYPES[name][1]
    return Layout(name, size, min(size, 4), [("", 0, name)])


def text(length):
    return Layout(f"STRING[{length}]", length + 1, 1, [("", 0, length)])


def structure(name, members):
    """A structure laid out as C does for 32 bits."""
    parts, size, alignment = [], 0, 1
    for member, layout in members:
        size += -size % layout.alignment
        parts += [(f".{member}{path}", size + offset, each) for path, offset, each in layout.parts]
        size += layout.size
        alignment = max(alignment, layout.alignment)
    return Layout(name, size + -size % alignment, alignment, parts)


def declared(layout, members):
    """The declaration of a structure."""
    lines = " ".join(f"{member} : {each.name};" for member, each in members)
    return f"{layout.name} : STRUCT {lines} END_STRUCT;"


def reference(target):
    return Layout(f"REFERENCE TO {target}", 4, 4, [])


INNER = [("a", elementary("SINT")), ("b", elementary("DINT")), ("c", elementary("BOOL"))]
Inner = structure("Inner", INNER)
LIST = Layout("ARRAY[0..2] OF UINT", 6, 2, [(f"[{n}]", 2 * n, "UINT") for n in range(3)])
OUTER = [
    ("flag", elementary("BOOL")),
    ("i", elementary("INT")),
    ("inner", Inner),
    ("list", LIST),
    ("l", elementary("LREAL")),
    ("r", elementary("REAL")),
    ("u", elementary("USINT")),
    ("name", text(7)),
    ("shade", elementary("Colour")),
    ("t", elementary("TIME")),
]
Outer = structure("Outer", OUTER)


class Block:
    """A random function block, in the order of Automation Studio's C: digital members last.

    Args:
        chance: its random numbers.
        name: of the block.
        inside: a block that it has an instance of, None for none.
    """

    def __init__(self, chance, name, inside=None, *, is_standard=False):
        self.name = name
        self._is_standard = is_standard
        inputs = [("x", "BOOL"), ("step", "INT"), ("factor", chance.choice(["REAL", "DINT"]))]
        outputs = [("n", "INT"), ("q", "BOOL"), ("total", "UDINT")]
        own = [("m", "INT"), ("seen", "BOOL"), ("last", "TIME"), ("shade", "Colour")]
        own += [("low", "SINT"), ("high", "USINT"), ("w", "UINT"), ("d", "DINT"), ("f", "REAL")]
        own += [("g", "LREAL")] + [(f"loop{n}", "INT") for n in range(6)]
        sections = [
            [(member, elementary(type_name)) for member, type_name in each]
            for each in (inputs, outputs, own)
        ]
        if inside is not None:
            sections[2].append(("inner", inside.layout))
        self._sections = sections
        digital = [[m for m in each if m[1].name == "BOOL"] for each in sections]
        analog = [[m for m in each if m[1].name != "BOOL"] for each in sections]
        self.layout = structure(name, [m for each in analog + digital for m in each])
        self.offsets = {path[1:]: offset for path, offset, _ in self.layout.parts}
        self.inputs = [(member, each, self.offsets[member]) for member, each in inputs]
        self.outputs = [(member, each, self.offsets[member]) for member, each in outputs]
        self.body = self._body(chance, inside)

    def _body(self, chance, inside):
        body = Body(chance)
        body.is_standard = self._is_standard
        body.can_return = True
        for path, offset, type_name in self.layout.parts:
            c = at(type_name, f"at+{offset}")
            if path.startswith(".loop"):
                body.loops.append((path[1:], c))
            elif not path.startswith(".inner.loop"):
                body.know(type_name, path[1:], c)
        if inside is not None:
            offset = self.offsets["inner.step"] - inside.offsets["step"]
            body.blocks.append(("inner", f"(at+{offset})", inside.inputs, inside.name))
        return body.statements(0, 4)

    @property
    def st(self):
        words = ("VAR_INPUT", "VAR_OUTPUT", "VAR")
        blocks = "".join(
            f"{word} {' '.join(f'{member} : {each.name};' for member, each in section)} END_VAR\n"
            for word, section in zip(words, self._sections, strict=True)
        )
        return f"FUNCTION_BLOCK {self.name}\n{blocks}{lines(self.body)}\nEND_FUNCTION_BLOCK\n"

    @property
    def c(self):
        return f"static void {self.name}(uint32_t at){{\n{join(self.body, 1)}\nout:;}}\n"


class Function:
    """A random function of values; ``functions`` are those that it may call."""

    def __init__(self, chance, name, functions, *, is_standard=False):
        self.name = name
        self.result = chance.choice(INTEGERS)
        types = [*INTEGERS, "REAL", "BOOL", "TIME"]
        self.parameters = [(f"x{n}", chance.choice(types)) for n in range(chance.randint(1, 4))]
        locals_ = {each: f"v{n}" for n, each in enumerate(TYPES)}
        self._locals = [(member, each) for each, member in locals_.items()]
        body = Body(chance)
        body.is_standard = is_standard
        body.can_return = True
        body.functions = [(each.name, each.result, each.parameters) for each in functions]
        for member, type_name in [*self.parameters, *self._locals]:
            body.know(type_name, member, member)
        body.know(self.result, name, "result")
        body.loops = [(f"loop{n}", f"loop{n}") for n in range(4)]
        self.body = body.statements(0, 4)

    @property
    def st(self):
        inputs = " ".join(f"{member} : {each};" for member, each in self.parameters)
        loops = [(f"loop{n}", "INT") for n in range(4)]
        others = " ".join(f"{member} : {each};" for member, each in [*self._locals, *loops])
        return (
            f"FUNCTION {self.name} : {self.result} VAR_INPUT {inputs} END_VAR\n"
            f"VAR {others} END_VAR\n{lines(self.body)}\nEND_FUNCTION\n"
        )

    @property
    def c(self):
        inputs = ",".join(f"{TYPES[each][0]} {member}" for member, each in self.parameters)
        others = "".join(f"{TYPES[each][0]} {member}=0;" for member, each in self._locals)
        loops = "int16_t loop0=0,loop1=0,loop2=0,loop3=0;"
        result = TYPES[self.result][0]
        return (
            f"static {result} {self.name}({inputs}){{{result} result=0;{others}{loops}\n"
            f"{join(self.body, 1)}\nout:return result;}}\n"
        )


class Program:
    """A random program; ``is_standard`` for the semantics of IEC 61131-3.

    Attributes:
        st: its text.
        c: its translation, the functions ``init_NAME`` and ``cyclic_NAME`` among others.
        variables: (name, address, bytes, type), in order.
        end: address behind the last one.
    """

    def __init__(self, seed, *, is_standard=False):
        self.name = f"p{seed}"
        self.is_standard = is_standard
        self.random = random.Random(seed)
        self.variables = []
        self.end = BASE
        self._body = body = Body(self.random)
        body.is_standard = is_standard
        self._functions = []
        for number in range(2):
            name = f"f{number}_{self.name}"
            known = self._functions[:]
            self._functions.append(Function(self.random, name, known, is_standard=is_standard))
        pulse = Block(self.random, f"Pulse_{self.name}", is_standard=is_standard)
        machine = Block(self.random, f"Machine_{self.name}", pulse, is_standard=is_standard)
        self._blocks = [pulse, machine]
        body.functions = [(each.name, each.result, each.parameters) for each in self._functions]
        self._declare_values()
        self._declare_aggregates()
        self._declare_blocks()
        self._declare_references()
        body.edges = 0
        self._actions = []
        for number in range(2):
            self._actions.append((f"act{number}", body.statements(1)))
            body.actions = [(f"act{number}", f"act{number}_{self.name}")]
        body.can_return = True
        self._cyclic = [body.statement() for _ in range(self.random.randint(3, 12))]

    # Variables

    def _add(self, name, layout):
        self.end += -self.end % layout.alignment
        address = self.end
        self.variables.append((name, address, layout.size, layout.name))
        self.end += layout.size
        return address

    def _declare_values(self):
        for type_name in TYPES:
            for number in range(2):
                name = f"{type_name.lower()}{number}"
                address = self._add(name, elementary(type_name))
                self._body.know(type_name, name, at(type_name, address))
        for number in range(LOOPS):
            address = self._add(f"loop{number}", elementary("INT"))
            self._body.loops.append((f"loop{number}", at("INT", address)))
        for number, length in enumerate((5, 12)):
            address = self._add(f"text{number}", text(length))
            self._body.strings.append((f"text{number}", f"(char*){address}", length))

    def _declare_aggregates(self):
        for number in range(2):
            self._known(f"outer{number}", Outer, self._add(f"outer{number}", Outer))
            name = f"list{number}"
            layout = Layout("ARRAY[-2..2] OF INT", 10, 2, [])
            address = self._add(name, layout)
            self._indexed("INT", name, "", [(-2, 5, 2)], address)
            self._body.aggregates.setdefault("list", []).append((name, address, 10))
        for type_name in ("USINT", "DINT", "REAL"):
            size = TYPES[type_name][1]
            layout = Layout(f"ARRAY[1..4] OF {type_name}", 4 * size, size, [])
            address = self._add(f"of_{type_name}", layout)
            self._indexed(type_name, f"of_{type_name}", "", [(1, 4, size)], address)
        grid = Layout("ARRAY[0..2, -1..1] OF UDINT", 36, 4, [])
        self._indexed("UDINT", "grid", "", [(0, 3, 12), (-1, 3, 4)], self._add("grid", grid))
        points = Layout("ARRAY[0..3] OF Inner", 4 * Inner.size, Inner.alignment, [])
        address = self._add("points", points)
        for path, offset, type_name in Inner.parts:
            self._indexed(type_name, "points", path, [(0, 4, Inner.size)], address + offset)
        alike = [(f"points[{n}]", address + n * Inner.size, Inner.size) for n in range(4)]
        self._body.aggregates["Inner"] = alike

    def _known(self, name, layout, address):
        """Make a structure and what is in it known; ``address`` may be a text of C."""
        for path, offset, part in layout.parts:
            if isinstance(part, str):
                self._body.know(part, f"{name}{path}", at(part, f"{address}+{offset}"))
            else:
                self._body.strings.append((f"{name}{path}", f"(char*)({address}+{offset})", part))
        self._body.aggregates.setdefault(layout.name, []).append((name, address, layout.size))

    def _indexed(self, type_name, name, path, dimensions, address):
        def element(body):
            indices = [body.index(low, count) for low, count, _ in dimensions]
            steps = zip(indices, dimensions, strict=True)
            offset = "+".join(f"{index}*{size}" for (_, index), (_, _, size) in steps)
            shown = ", ".join(st for st, _ in indices)
            return f"{name}[{shown}]{path}", at(type_name, f"{address}+{offset}")

        self._body.places.setdefault(type_name, []).append(element)

    def _declare_blocks(self):
        for block in self._blocks:
            for number in range(2):
                name = f"{block.name}_{number}"
                address = self._add(name, block.layout)
                self._body.blocks.append((name, str(address), block.inputs, block.name))
                for output, type_name, offset in block.outputs:
                    self._body.know(type_name, f"{name}.{output}", at(type_name, address + offset))

    def _declare_references(self):
        self._linked = []
        for type_name in ("INT", "UDINT", "USINT", "Outer"):
            name = f"ref_{type_name}"
            address = self._add(name, reference(type_name))
            cell = f"(*(uint32_t*){address})"
            self._body.references.append((name, cell, type_name))
            target = f"{type_name.lower()}0"
            places = {each[0]: each[1] for each in self.variables}
            self._linked.append((name, cell, target, places[target]))
            if type_name == "Outer":
                self._known(name, Outer, cell)
            else:
                self._body.know(type_name, name, at(type_name, cell))

    # Texts

    @property
    def st(self):
        colours = ", ".join(f"{name} := {value}" for name, value in COLOURS.items())
        variables = "\n".join(f"{name} : {type_name};" for name, _, _, type_name in self.variables)
        links = " ".join(f"{name} ACCESS ADR({target});" for name, _, target, _ in self._linked)
        return "".join(
            [
                f"TYPE Colour : ({colours}); {declared(Inner, INNER)}\n",
                f"{declared(Outer, OUTER)} END_TYPE\n",
                *(each.st for each in self._functions),
                *(each.st for each in self._blocks),
                f"PROGRAM _INIT {links} END_PROGRAM\n",
                f"PROGRAM _CYCLIC\n{lines(self._cyclic)}\nEND_PROGRAM\n",
                *(f"ACTION {name}:\n{lines(body)}\nEND_ACTION\n" for name, body in self._actions),
                f"VAR\n{variables}\nEND_VAR\n",
            ]
        )

    @property
    def c(self):
        links = "".join(f"{cell}={address};" for _, cell, _, address in self._linked)
        actions = "".join(
            f"static void {name}_{self.name}(void){{\n{join(body, 1)}\n}}\n"
            for name, body in self._actions
        )
        return "".join(
            [
                *(each.c for each in self._functions),
                *(each.c for each in self._blocks),
                actions,
                f"void init_{self.name}(void){{{links}}}\n",
                f"void cyclic_{self.name}(void){{\n{join(self._cyclic, 1)}\nout:;}}\n",
            ]
        )


def lines(statements):
    """Statements, a line each."""
    return join(statements, 0).replace("; ", ";\n")


def c_file(programs):
    """The translations of several programs, and a main that runs them on request.

    It gets a file that it maps to the addresses of the variables, and their size. What it reads
    are numbers of units (``2 n`` is the INIT of program n, ``2 n + 1`` its CYCLIC); to each it
    answers a byte.
    """
    units = ",".join(f"init_{each.name},cyclic_{each.name}" for each in programs)
    return f"{HEAD}{''.join(each.c for each in programs)}{_MAIN % (units, BASE, BASE)}"


_MAIN = """
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>
static void (*const units[])(void) = {%s};
int main(int count, char **arguments) {
    int file = open(arguments[1], O_RDWR);
    unsigned number;
    void *found = mmap((void *)%#x, atoi(arguments[2]), PROT_READ | PROT_WRITE,
                       MAP_SHARED | MAP_FIXED, file, 0);
    if (found != (void *)%#x) return 1;
    while (read(0, &number, 4) == 4) {
        units[number]();
        if (write(1, "", 1) != 1) return 1;
    }
    return 0;
}
"""
