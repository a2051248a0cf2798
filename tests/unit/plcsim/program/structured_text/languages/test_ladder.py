"""Ladder Diagrams: what each element of a network does when it runs."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plcsim.program.structured_text.check.declared import declarations_of
from plcsim.program.structured_text.check.program import check_program
from plcsim.program.structured_text.languages.readers import parse_units
from st_types.resolve.dialect import AUTOMATION_STUDIO
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations
from st_types.syntax.source import Source

from ..running import Running, checked, standard

FLAGS = "VAR a, b, c, d, x, y, z : BOOL; i, j, k : INT; t : TON; END_VAR"


def contact(name, kind="open", more=""):
    return f'<contact type="{kind}" name="{name}"{more}/>'


def coil(name, kind="open"):
    return f'<coil type="{kind}" name="{name}"/>'


LINE, EMPTY, JOIN, UP = "<line/>", "<empty/>", '<line or="true"/>', '<empty or="true"/>'


def network(*rows, head=""):
    cells = "\n".join(f"<row>{''.join(row)}</row>" for row in rows)
    return f"<network {head}>\n{cells}\n</network>"


def ladder(*networks, unit="PROGRAM _CYCLIC", end="END_PROGRAM"):
    return (
        f'{unit}\n<?xml version="1.0"?>\n<?AutomationStudio Version=3.0?>\n'
        f'<networks maxcolumn="8">\n{"".join(networks)}\n</networks>\n{end}\n'
    )


def ton(running, address):
    """Q is what IN is, and ET what PT is."""
    for source, taken, size in (("IN", "Q", 1), ("PT", "ET", 4)):
        value = running.memory.read(address + offset(running, source), size)
        running.memory.write(address + offset(running, taken), value)


def offset(running, member):
    return running.address(f"t.{member}") - running.address("t")


@pytest.fixture
def run():
    opened = []

    def start(*networks, declarations=FLAGS, **options):
        running = Running(ladder(*networks), declarations, path="Main.ld", TON=ton, **options)
        opened.append(running)
        return running

    yield start
    for each in opened:
        each.close()


def cycle(running, *names, **values):
    for name, value in values.items():
        running[name] = value
    running.run()
    found = tuple(running[name] for name in names)
    return found[0] if len(found) == 1 else found


def test_contacts_in_series_and_a_closed_one(run):
    running = run(network([contact("a"), contact("b", "closed"), LINE, coil("x")]))
    found = [cycle(running, "x", a=a, b=b) for a in (False, True) for b in (False, True)]
    assert found == [False, False, True, False]


def test_a_motor_seals_itself_in(run):
    running = run(
        network(
            [contact("a"), contact("b", "closed"), LINE, coil("x")],
            [contact("x", more=' or="true"'), EMPTY, EMPTY, EMPTY],
        )
    )
    found = [cycle(running, "x", a=a, b=b) for a, b in ((1, 0), (0, 0), (0, 1), (0, 0))]
    assert found == [True, True, False, False]


def test_a_branch_from_one_vertical_line_to_another(run):
    """As the editor draws it: an empty cell with a line at its right edge opens the branch."""
    running = run(
        network(
            [contact("a"), contact("b"), LINE, coil("x")],
            [UP, contact("c"), JOIN, EMPTY],
            [UP, contact("d"), JOIN, EMPTY],
        )
    )
    cases = {(0, 1, 1, 1): 0, (1, 0, 0, 0): 0, (1, 1, 0, 0): 1, (1, 0, 1, 0): 1, (1, 0, 0, 1): 1}
    for (a, b, c, d), power in cases.items():
        assert cycle(running, "x", a=a, b=b, c=c, d=d) == power


def test_power_does_not_flow_back_to_the_left(run):
    running = run(network([contact("a"), contact("b"), coil("x")], [contact("c"), JOIN, coil("y")]))
    assert cycle(running, "x", "y", c=True) == (True, True)
    running = run(network([contact("a", more=""), LINE, coil("x")], [UP, contact("b"), coil("y")]))
    assert cycle(running, "x", "y", a=False, b=True) == (False, False)
    assert cycle(running, "x", "y", a=True, b=True) == (True, True)


def test_coils_in_one_rung_and_those_of_their_kinds(run):
    running = run(
        network([contact("a"), coil("x"), coil("y", "closed")]),
        network([contact("b"), coil("z", "set")]),
        network([contact("c"), coil("z", "reset")]),
    )
    assert cycle(running, "x", "y", a=True) == (True, False)
    assert cycle(running, "x", "y", a=False) == (False, True)
    assert [cycle(running, "z", b=b, c=c) for b, c in ((1, 0), (0, 0), (0, 1), (1, 1))] == [
        *(True, True, False, False)
    ]


def test_coils_below_each_other_share_what_leads_to_them(run):
    edge = contact("a", "positive transition")
    running = run(
        network(
            [edge, LINE, coil("x")],
            [UP, contact("b"), coil("y")],
            [UP, LINE, coil("z", "set")],
        )
    )
    found = [cycle(running, "x", "y", "z", a=a, b=1) for a in (0, 1, 1)]
    assert found == [(0, 0, 0), (1, 1, 1), (0, 0, 1)]


def test_a_contact_below_a_coil_reads_the_new_value(run):
    running = run(network([contact("a"), coil("x")], [contact("x"), coil("y")]))
    assert cycle(running, "x", "y", a=True) == (True, True)


@pytest.mark.parametrize(
    ("kind", "expected"),
    [("positive transition", [0, 1, 0, 0, 1]), ("negative transition", [0, 0, 0, 1, 0])],
)
def test_edges_of_contacts_and_coils(run, kind, expected):
    running = run(
        network([contact("a", kind), coil("x")]), network([contact("a"), coil("y", kind)])
    )
    found = [cycle(running, "x", "y", a=a) for a in (0, 1, 1, 0, 1)]
    assert found == [(each, each) for each in expected]


def test_an_edge_of_an_edge(run):
    rung = [contact("a", "positive transition"), coil("x", "positive transition")]
    running = run(network(rung))
    assert [cycle(running, "x", a=a) for a in (0, 1, 1, 0, 1)] == [0, 1, 0, 0, 1]


def test_an_edge_is_seen_while_the_rung_is_open(run):
    """Each contact looks at its variable in every cycle, whatever leads to it."""
    running = run(network([contact("b"), contact("a", "positive transition"), coil("x")]))
    assert [cycle(running, "x", a=1, b=b) for b in (0, 1)] == [False, False]


def test_jumps_labels_and_return(run):
    running = run(
        network([contact("a"), coil("over", "jump")]),
        network([LINE, coil("x")]),
        network([contact("b"), '<coil type="return"/>'], head='label="over" comment="to here"'),
        network([coil("y")]),
    )
    assert cycle(running, "x", "y", a=1, b=1) == (False, False)
    assert cycle(running, "x", "y", a=1, b=0) == (False, True)
    assert cycle(running, "x", "y", a=0, b=1) == (True, True)


def test_a_jump_without_a_condition(run):
    running = run(
        network([LINE, coil("end", "jump")]),
        network([coil("x")]),
        network([coil("y")], head='label="end"'),
    )
    assert cycle(running, "x", "y") == (False, True)


def test_networks_that_are_commented_out_do_nothing(run):
    running = run(
        network([coil("x"), "<nonsense/>"], head='label="n" commented="1"'),
        network([coil("y")], head='commented="0"'),
    )
    assert cycle(running, "x", "y") == (False, True)


def block(kind, rows, name="", of=""):
    """The cells of a block, from its header on: the names of an input and an output each."""
    head = f' name="{name}"' if name else ""
    cells = [f'<{kind} position="header"{head}/>']
    for number, (source, taken) in enumerate(rows):
        place = "top" if not number else "bottom" if number == len(rows) - 1 else "middle"
        kinds = f' type="{of}"' if not number else ""
        pins = f'<input name="{source}"/>' * (source is not None)
        pins += f'<output name="{taken}"/>' * (taken is not None)
        cells.append(f'<{kind} position="{place}"{kinds}>{pins}</{kind}>')
    return cells


def analog(name):
    return f'<analog name="{name}"/>'


def test_a_timer_in_a_rung(run):
    header, top, bottom = block("functionblock", [("IN", "Q"), ("PT", "ET")], "t", "TON")
    running = run(
        network(
            [EMPTY, EMPTY, header, EMPTY, EMPTY],
            [contact("a"), contact("b", "closed"), top, LINE, coil("x")],
            [EMPTY, analog("T#1s500ms"), bottom, analog("e"), EMPTY],
        ),
        declarations=FLAGS + " VAR e : TIME; END_VAR",
    )
    assert cycle(running, "x", "t.IN", "e", a=1) == (True, True, 1500)
    assert cycle(running, "x", "t.IN", b=1) == (False, False)


def test_a_block_whose_outputs_nothing_takes_is_called_too(run):
    header, top, bottom = block("functionblock", [("IN", "Q"), ("PT", "ET")], "t", "TON")
    running = run(network([EMPTY, header], [contact("a"), top], [analog("T#2s"), bottom]))
    assert cycle(running, "t.Q", "t.ET", a=1) == (True, 2000)


def test_blocks_one_behind_the_other(run):
    first = block("functionblock", [("IN", "Q"), ("PT", "ET")], "t", "TON")
    second = block("functionblock", [("IN", "Q"), ("PT", "ET")], "s", "TON")
    running = run(
        network(
            [EMPTY, first[0], EMPTY, second[0], EMPTY],
            [contact("a"), first[1], contact("b"), second[1], coil("x")],
            [analog("T#1s"), first[2], LINE, second[2], EMPTY],
        ),
        declarations=FLAGS + " VAR s : TON; END_VAR",
    )
    assert cycle(running, "x", "s.PT", a=1, b=1) == (True, 1000)
    assert cycle(running, "x", a=1, b=0) is False


def test_functions_with_and_without_en(run):
    move = block("function", [("EN", "ENO"), ("IN", "OUT")], of="MOVE")
    add = block("function", [("", ""), ("", None)], of="ADD")
    running = run(
        network(
            [EMPTY, move[0], EMPTY],
            [contact("a"), move[1], coil("x")],
            [analog("i"), move[2], analog("j")],
        ),
        network([EMPTY, add[0], EMPTY], [analog("i"), add[1], analog("k")], [analog("5"), add[2]]),
    )
    assert cycle(running, "j", "k", "x", i=7) == (0, 12, False)
    assert cycle(running, "j", "k", "x", a=1) == (7, 12, True)
    assert cycle(running, "j", "k", "x", a=0, i=9) == (7, 14, False)


def test_a_comparison_drives_a_coil_and_a_result_another_function(run):
    equal = block("function", [("EN", "ENO"), ("IN1", "OUT"), ("IN2", None)], of="GT")
    add = block("function", [("IN1", "OUT"), ("IN2", None)], of="ADD")
    multiply = block("function", [("IN1", "OUT"), ("IN2", None)], of="MUL")
    running = run(
        network(
            [EMPTY, equal[0], EMPTY],
            [contact("a"), equal[1], EMPTY],
            [analog("i"), equal[2], coil("x")],
            [analog("10"), equal[3], EMPTY],
        ),
        network(
            [EMPTY, add[0], EMPTY, multiply[0], EMPTY],
            [analog("i"), add[1], LINE, multiply[1], analog("j")],
            [analog("1"), add[2], analog("3"), multiply[2], EMPTY],
        ),
    )
    assert cycle(running, "x", "j", i=11, a=1) == (True, 36)
    assert cycle(running, "x", "j", i=11, a=0) == (False, 36)
    assert cycle(running, "x", "j", i=10, a=1) == (False, 33)


def test_a_result_is_stored_in_several_operands(run):
    add = block("function", [("EN", "ENO"), ("IN1", "OUT"), ("IN2", None)], of="ADD")
    running = run(
        network(
            [EMPTY, add[0]],
            [contact("a"), add[1]],
            [analog("i"), add[2], analog("j"), analog("k")],
            [analog("1"), add[3]],
        )
    )
    assert cycle(running, "j", "k", i=3) == (0, 0)
    assert cycle(running, "j", "k", a=1) == (4, 4)


def test_a_result_that_may_not_be_there_is_not_stored():
    move = block("function", [("EN", "ENO"), ("IN", "OUT")], of="MOVE")
    text = ladder(
        network(
            [EMPTY, move[0], EMPTY, EMPTY],
            [contact("a"), move[1], LINE, EMPTY],
            [analog("i"), move[2], JOIN, analog("j")],
        )
    )
    records = parse_units(Source("Main.ld", text)).diagnostics.records
    assert "network 1: j takes a result that is only there when EN is TRUE" in records[0].message


def test_compare_and_compute_take_their_name_as_expression(run):
    compare = block("function", [("EN", "ENO")], "i &gt; 5 AND j &lt;&gt; 1", "Compare!")
    compute = block("function", [("EN", "ENO"), (None, "OUT")], "i * 2 + j", "Compute!")
    running = run(
        network([EMPTY, compare[0]], [contact("a"), compare[1], coil("x")]),
        network([EMPTY, compute[0]], [contact("a"), compute[1]], [EMPTY, compute[2], analog("k")]),
    )
    assert cycle(running, "x", "k", a=1, i=6, j=3) == (True, 15)
    assert cycle(running, "x", "k", a=1, i=6, j=1) == (False, 13)
    assert cycle(running, "x", "k", a=0, j=3) == (False, 13)


def test_a_function_block_with_en_and_eno(run):
    rows = [("EN", "ENO"), ("IN", "Q"), ("PT", "ET")]
    header, top, middle, bottom = block("functionblock", rows, "t", "TON")
    running = run(
        network(
            [EMPTY, header, EMPTY],
            [contact("a"), top, coil("x")],
            [contact("b"), middle, coil("y")],
            [analog("T#1s"), bottom, EMPTY],
        )
    )
    assert cycle(running, "x", "y", a=0, b=1) == (False, False)
    assert cycle(running, "x", "y", a=1, b=1) == (True, True)
    assert cycle(running, "x", "y", a=0, b=0) == (False, True)


def test_blocks_below_each_other_in_one_column(run):
    one = ['<function position="single" type="NOT"><input name=""/><output name=""/></function>']
    two = block("functionblock", [("IN", "Q"), ("PT", "ET")], "t", "TON")
    running = run(
        network(
            [EMPTY, two[0], EMPTY],
            [contact("a"), two[1], coil("x")],
            [analog("T#1s"), two[2], EMPTY],
            [contact("b"), *one, coil("y")],
            [contact("c"), *one, coil("z")],
        )
    )
    assert cycle(running, "x", "y", "z", a=1, b=1, c=0) == (True, False, True)


def test_the_name_of_a_function_is_its_type_where_it_has_none(run):
    running = run(
        network(
            [EMPTY, '<function position="header" name="NOT"/>', EMPTY],
            [contact("a"), block("function", [("", "")])[1], coil("x")],
        )
    )
    assert cycle(running, "x", a=0) is True


def test_a_large_network_is_read(run):
    rows = [[contact("b"), LINE, JOIN, EMPTY]] * 2000
    running = run(network([contact("a"), LINE, LINE, coil("x")], *rows))
    assert [cycle(running, "x", b=b) for b in (0, 1)] == [False, True]
    wide = [contact("a")] * 98
    assert cycle(run(network([*wide, coil("x")], [*[UP] * 97, LINE, coil("y")])), "x", a=1) is True


def test_a_chain_of_blocks_as_long_as_a_row(run):
    one = '<function position="single" type="NOT"><input name=""/><output name=""/></function>'
    running = run(network([contact("a"), *[one] * 98, coil("x")]))
    assert cycle(running, "x", a=1) is True
    running = run(network([*[EMPTY] * 99, coil("x")], [contact("a"), *[one] * 97, JOIN, LINE]))
    assert cycle(running, "x", a=1) is False


CELLS = st.sampled_from(
    [
        *(contact("a"), contact("b", "closed", ' or="true"'), contact("c", "positive transition")),
        *(coil("x"), coil("y", "set"), coil("n", "jump"), analog("i"), analog("j")),
        *(LINE, EMPTY, JOIN, UP, LINE, EMPTY),
        *block("functionblock", [("IN", "Q"), ("EN", "ENO"), ("PT", "ET")], "t", "TON"),
        *block("function", [("EN", "ENO"), ("", ""), ("", None)], of="ADD"),
        *block("function", [("", "")], "i &gt; 1", "Compare!"),
    ]
)


@settings(max_examples=60)
@given(st.lists(st.lists(CELLS, max_size=8), max_size=6))
def test_any_grid_is_read_or_told(rows):
    file = parse_units(Source("Main.ld", ladder(network(*rows, head='label="n"'))))
    if not file.diagnostics.records:
        declared = parse_declarations(Source("a.var", FLAGS))
        scope = Scope("program", [declared, declarations_of(file)], [standard(AUTOMATION_STUDIO)])
        check_program("program", [file], scope)


def test_an_address_of_a_variable(run):
    move = block("function", [("", "")], of="MOVE")
    running = run(
        network([EMPTY, move[0]], [contact("i", "address"), move[1], analog("p")]),
        declarations=FLAGS + " VAR p : UDINT; END_VAR",
    )
    assert cycle(running, "p") == running.address("i")


def test_members_elements_bits_and_constants_as_operands(run):
    running = run(
        network([contact("m.on"), contact("list[1]"), contact("i.3"), coil("m.off")]),
        network([contact("TRUE"), coil("x")]),
        declarations=FLAGS
        + " TYPE M : STRUCT on, off : BOOL; END_STRUCT; END_TYPE"
        + " VAR m : M; list : ARRAY[0..2] OF BOOL; END_VAR",
    )
    running["m.on"], running["list[1]"] = True, True
    assert cycle(running, "m.off", "x", i=8) == (True, True)
    assert cycle(running, "m.off", i=7) is False


def test_functions_blocks_and_actions_in_ladder():
    text = (
        ladder(
            network([contact("in"), coil("out", "closed")]),
            unit="FUNCTION_BLOCK Inverter",
            end="END_FUNCTION_BLOCK",
        )
        + ladder(network([LINE, coil("x")]), unit="ACTION Switch:", end="END_ACTION")
        + "(* calls both *)\n"
        + ladder(
            network(
                [EMPTY, '<functionblock position="header" name="inv"/>'],
                [
                    contact("a"),
                    block("functionblock", [("in", "out")], of="Inverter")[1],
                    coil("y"),
                ],
            )
        )
    )
    declared = (
        FLAGS + " VAR inv : Inverter; END_VAR FUNCTION_BLOCK Inverter"
        " VAR_INPUT in : BOOL; END_VAR VAR_OUTPUT out : BOOL; END_VAR END_FUNCTION_BLOCK"
    )
    running = Running(text, declared, path="Main.LD")
    assert cycle(running, "y", a=0) is True
    assert cycle(running, "y", a=1) is False
    running.close()


@pytest.mark.parametrize("text", ["", "\r\n", "(* later *)"])
def test_a_file_without_units(text):
    file = parse_units(Source("Main.ld", text))
    assert file.units == []
    assert file.diagnostics.records == []


@pytest.mark.parametrize(
    ("networks", "line", "told"),
    [
        (network(["<spiral/>"]), 5, "network 1: element <spiral> is not known"),
        (network([contact("a", "half")]), 5, "network 1: the type 'half' of a contact is not"),
        (network([coil("a", "half")]), 5, "network 1: the type 'half' of a coil is not known"),
        (network([contact("")]), 5, "network 1: a contact has no name"),
        (network([contact("a", more=' invert="1"')]), 5, "network 1: the attribute invert='1'"),
        (network([contact("a", more=' or="maybe"')]), 5, "network 1: or='maybe' is neither"),
        ("<page/>", 4, "network 1: element <page> is not known"),
        (network([EMPTY, contact("a"), coil("x")]), 5, "nothing leads to the contact a"),
        (network([EMPTY, coil("x")]), 5, "network 1: nothing leads to the coil x"),
        (network([contact("a +"), coil("x")]), 5, "expected a value, found ';'"),
        (network([contact("a b"), coil("x")]), 5, "expected an operator or the end of the"),
        (network(block("function", [("", "")])[1:]), 5, "network 1: a block has no type"),
        (
            network(block("function", [("IN1", "OUT")], of="ADD")[1:][::-1], []).replace(
                "<row><fun", "<row><empty/><fun"
            ),
            5,
            "network 1: nothing leads to the input IN1 of ADD",
        ),
        (
            network([block("functionblock", [("IN", "Q")], of="TON")[1]]),
            5,
            "network 1: the function block of type TON has no instance",
        ),
        (network([LINE] * 101), 5, "network 1: a row has more than 100 cells"),
        ("<network><row></network>", 4, "it is no XML: mismatched tag"),
        ('<network a="é"/><network><row><what/></row></network>', 4, "element <what> is not"),
    ],
)
def test_what_is_not_known_is_told_with_its_place(networks, line, told):
    records = parse_units(Source("Main.ld", ladder(networks))).diagnostics.records
    assert any(told in each.message for each in records), [each.render() for each in records]
    assert records[-1].line in (line, line + 1)


def test_an_attribute_of_the_editor_is_a_warning():
    text = ladder(network([contact("a", more=' width="3"'), coil("x")], head='zoom="90"'))
    records = parse_units(Source("Main.ld", text)).diagnostics.records
    assert [(each.severity, each.message) for each in records] == [
        ("warning", "network 1: the attribute zoom='90' of <network> is not known"),
        ("warning", "network 1: the attribute width='3' of <contact> is not known"),
    ]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("PROGRAM _CYCLIC\n<networks/>\n", "expected END_PROGRAM behind the networks"),
        ("PROGRAM _CYCLIC\nx := 1;\n<networks/>\nEND_PROGRAM", "it is no XML: "),
        ("PROGRAM _CYCLIC\n<page/>\nEND_PROGRAM", "expected <networks>, found <page>"),
        ("PROGRAM _CYCLIC\n<networks/>\nEND_ACTION", "expected END_PROGRAM"),
        ("LD a\nST b", "expected a unit"),
        ("PROGRAM _CYCLIC\n<networks/>\nEND_PROGRAM more", "expected a unit"),
    ],
)
def test_what_is_no_ladder_diagram(text, told):
    records = parse_units(Source("Main.ld", text)).diagnostics.records
    assert told in records[0].message


def test_findings_of_the_checker_stand_at_the_operand():
    text = ladder(network([contact("a"), contact("gone"), coil("x")]))
    _, _, found = checked(text, FLAGS, path="Main.ld")
    column = text.splitlines()[5].index("gone") + 1
    assert any(each.startswith(f"6:{column} ST2001 no variable is called gone") for each in found)
