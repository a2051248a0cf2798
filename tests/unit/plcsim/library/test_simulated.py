"""Blocks that follow a table where nothing executes them."""

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.simulated import Rules, built_in_rules, result_body, table_body
from st_types import BOOL, DINT, INT, UDINT, UINT
from st_types.types.derived import DataBlockType, Member, Section, StructType

BLOCK = DataBlockType(
    "Alarm",
    [
        Member("Enable", BOOL, section=Section.INPUT),
        Member("Level", INT, section=Section.INPUT),
        Member("Active", BOOL, section=Section.OUTPUT),
        Member("Error", BOOL, section=Section.OUTPUT),
        Member("StatusID", DINT, section=Section.OUTPUT),
        Member("Actual", INT, section=Section.OUTPUT),
        Member("Hidden", BOOL),
    ],
)


@pytest.fixture
def run():
    """``run(rules, Enable=1)``: the values of all members after one call."""
    memory = Memory()

    def run(rules, **inputs):
        address = memory.allocate(BLOCK.size)
        for name, value in inputs.items():
            member, offset = BLOCK.find(name)
            memory.set(member.data_type, address + offset, value)
        table_body(BLOCK, rules).bind(Context(memory, None))(address)
        return {
            member.name: memory.get(member.data_type, address + offset)
            for member, offset in zip(BLOCK.members, BLOCK.offsets, strict=True)
        }

    return run


def test_outputs_follow_inputs_or_keep_a_value(run):
    rules = {"Active": "Enable", "Actual": "Level", "StatusID": -7, "Error": True}
    values = run(rules, Enable=True, Level=-3)
    assert (values["Active"], values["Actual"]) == (True, -3)
    assert (values["StatusID"], values["Error"]) == (-7, True)
    assert run(rules, Enable=False)["Active"] is False


COMMANDS = DataBlockType(
    "Recipe",
    [
        Member("Enable", BOOL, section=Section.INPUT),
        Member("Load", BOOL, section=Section.INPUT),
        Member("Save", BOOL, section=Section.INPUT),
        Member("Active", BOOL, section=Section.OUTPUT),
        Member("CommandDone", BOOL, section=Section.OUTPUT),
    ],
)


@pytest.mark.parametrize(
    ("commands", "done"), [({}, 0), ({"Load": 1}, 1), ({"Save": 1}, 1), ({"Enable": 1}, 0)]
)
def test_an_output_follows_the_first_of_several_inputs_that_is_not_0(commands, done):
    memory = Memory()
    address = memory.allocate(COMMANDS.size)
    body = table_body(COMMANDS, built_in_rules().of("Recipe"))
    assert body.text == "Active follows Enable, CommandDone follows Load or Save"
    for name, value in commands.items():
        memory.set(BOOL, address + COMMANDS.find(name)[1], value)
    body.bind(Context(memory, None))(address)
    assert memory.get(BOOL, address + COMMANDS.find("CommandDone")[1]) == done


def test_rules_that_do_not_fit_are_no_rules(run):
    assert table_body(BLOCK, {"Done": "Execute", "Actual": "Enable", "Hidden": "Enable"}) is None
    assert table_body(BLOCK, {"Error": False}) is None
    assert run({"Active": "Enable", "Enable": "Enable", "Done": "Enable"}, Enable=True)["Active"]


def test_a_component_is_active_when_it_is_enabled():
    body = table_body(BLOCK, built_in_rules().of("Alarm"))
    assert body.text == "Active follows Enable"


def test_a_project_adds_rules_to_those_of_a_block():
    rules = Rules({"Active": "Enable"}, {"Alarm": {"Error": False}})
    found = rules.extended({"Alarm": {"Actual": "Level"}, "Other": {"Done": "Execute"}})
    assert found.of("Alarm") == {"Active": "Enable", "Error": False, "Actual": "Level"}
    assert found.of("Other") == {"Active": "Enable", "Done": "Execute"}


ROBOT = DataBlockType(
    "Robot",
    [
        *(
            Member(n, BOOL, section=Section.INPUT)
            for n in ("ENABLE", "Power", "Home", "Jog", "InitCam")
        ),
        *(
            Member(name, BOOL, section=Section.OUTPUT)
            for name in ("Active", "PowerOn", "IsHomed", "JogActive", "OtherDone", "CamInitialized")
        ),
        Member(
            "Info",
            StructType("Info", [Member("Count", INT), Member("ReadyToPowerOn", BOOL)]),
            section=Section.OUTPUT,
        ),
    ],
)


@pytest.fixture
def robot():
    """``robot(ENABLE=1)``: a call with these inputs; the names of what is TRUE then."""
    context = Context(Memory(), None)
    memory, address = context.memory, context.memory.allocate(ROBOT.size)
    body = table_body(ROBOT, built_in_rules().of("Robot"))
    run = body.bind(context)

    def call(**inputs):
        for name, value in inputs.items():
            memory.set(BOOL, address + ROBOT.find(name)[1], value)
        run(address)
        places = {
            each.name: ROBOT.find(each.name)[1]
            for each in ROBOT.members
            if each.section is Section.OUTPUT
        }
        places["Info"] += 2
        return {name for name, offset in places.items() if memory.get(BOOL, address + offset)}

    return call


def test_an_output_that_is_held_keeps_what_a_command_made_of_it(robot):
    assert robot(Home=True) == set()
    assert "IsHomed" in robot(ENABLE=True)
    assert "IsHomed" in robot(Home=False)
    assert "IsHomed" not in robot(ENABLE=False)
    assert "IsHomed" not in robot(ENABLE=True)


def test_members_of_structures_and_names_in_any_case(robot):
    assert robot(ENABLE=True) == {"Active", "Info"}
    assert robot(Power=True) == {"Active", "Info", "PowerOn"}


def test_an_output_that_is_named_after_an_input_follows_it(robot):
    assert robot(Jog=True) == {"JogActive"}
    assert robot(Jog=False) == set()
    assert robot(InitCam=True) == {"CamInitialized"}


@pytest.mark.parametrize("rule", ["Home while Nothing", "Nothing while ENABLE"])
def test_what_is_held_by_no_input_is_no_rule(rule):
    assert table_body(ROBOT, {"IsHomed": rule}) is None


def test_an_output_that_a_program_wrote_is_written_again(robot):
    assert robot(ENABLE=True) == {"Active", "Info"}
    assert robot() == {"Active", "Info"}
    assert robot(Active=False, PowerOn=True) == {"Active", "Info"}


def _classic(*internals, status=UINT):
    return DataBlockType(
        "IcmpPing",
        [
            Member("enable", BOOL, section=Section.INPUT),
            Member("status", status, section=Section.OUTPUT),
            *(Member(name, UINT) for name in internals),
        ],
    )


@pytest.mark.parametrize(
    ("block", "statuses", "text"),
    [
        (_classic("i_state"), [0xFFFE, 0xFFFF, 0, 0xFFFF, 0xFFFE], "status is BUSY once, then 0"),
        (_classic("old"), [0xFFFE, 0, 0, 0, 0xFFFE], "status is 0"),
    ],
)
def test_a_block_with_enable_has_the_statuses_of_the_controller(block, statuses, text):
    memory = Memory()
    address = memory.allocate(block.size)
    body = table_body(block, built_in_rules().of(block.name))
    assert body.text == text
    run = body.bind(Context(memory, None))
    found = []
    for enable in (False, True, True, True, False):
        memory.set(BOOL, address + block.find("enable")[1], enable)
        run(address)
        found.append(memory.get(UINT, address + block.find("status")[1]))
    assert found == statuses


@pytest.mark.parametrize(
    ("internal", "text", "statuses"),
    [
        ("i_state", "status is BUSY once, then 8877", [0xFFFE, 0xFFFF, 8877]),
        ("old", "status is 8877", [0xFFFE, 8877, 8877]),
    ],
)
def test_a_rule_says_with_which_status_a_block_ends(internal, text, statuses):
    memory = Memory()
    block = _classic(internal)
    address = memory.allocate(block.size)
    body = table_body(block, {"status": 8877})
    assert body.text == text
    run = body.bind(Context(memory, None))
    found = []
    for enable in (False, True, True):
        memory.set(BOOL, address + block.find("enable")[1], enable)
        run(address)
        found.append(memory.get(UINT, address + block.find("status")[1]))
    assert found == statuses


def test_a_status_that_follows_an_input_has_no_end():
    assert table_body(_classic("i_state"), {"status": "enable"}) is None
    assert table_body(_classic("i_state", status=BOOL), {}) is None


OPENING = DataBlockType(
    "MBMOpen",
    [
        Member("enable", BOOL, section=Section.INPUT),
        Member("status", UINT, section=Section.OUTPUT),
        Member("ident", UDINT, section=Section.OUTPUT),
    ],
)


def test_what_names_a_connection_is_not_0_once_it_was_opened():
    memory = Memory()
    address = memory.allocate(OPENING.size)
    body = table_body(OPENING, built_in_rules().of("MBMOpen"))
    assert body.text == "ident is 1 once enable, status is 0"
    run = body.bind(Context(memory, None))
    found = []
    for enable in (False, True, False):
        memory.set(BOOL, address + OPENING.find("enable")[1], enable)
        run(address)
        found.append(memory.get(UDINT, address + OPENING.find("ident")[1]))
    assert found == [0, 1, 1]


@pytest.mark.parametrize("rule", ["1 once Home", "Home once enable", "-1 once enable"])
def test_what_comes_once_is_a_number_at_an_input(rule):
    assert table_body(OPENING, {"ident": rule, "status": "enable"}) is None


@pytest.mark.parametrize(
    ("name", "status"),
    [("CANread", 8877), ("CANopenRecvEmcy", 30820), ("CANopenPDORead8", 30847)],
)
def test_a_block_that_receives_has_received_nothing(name, status):
    body = table_body(_classic("old"), built_in_rules().of(name))
    assert body.text == f"status is {status}"


DETAILS = DataBlockType(
    "ArCertGetOwnDetails",
    [Member("Execute", BOOL, section=Section.INPUT)]
    + [Member(name, BOOL, section=Section.OUTPUT) for name in ("Done", "Error")]
    + [Member("StatusID", DINT, section=Section.OUTPUT)],
)


def test_a_list_of_certificates_has_no_entry():
    memory = Memory()
    address = memory.allocate(DETAILS.size)
    body = table_body(DETAILS, built_in_rules().of(DETAILS.name))
    assert body.text == "Error follows Execute"
    memory.set(BOOL, address + DETAILS.find("Execute")[1], True)
    body.bind(Context(memory, None))(address)
    values = [memory.get(BOOL, address + DETAILS.find(name)[1]) for name in ("Done", "Error")]
    assert values == [False, True]
    assert memory.get(DINT, address + DETAILS.find("StatusID")[1]) == -1070585796


@pytest.mark.parametrize(
    ("name", "result"),
    [("VA_Setup", 1), ("VA_GetActAlarmList", 240), ("VA_wcGetExAlarmList", 240), ("MO_list", 1)],
)
def test_a_function_returns_what_the_table_says(name, result):
    body = result_body(name, built_in_rules().of(name))
    assert body.bind(Context(Memory(), None))(1, 2, 3) == result


def test_the_command_of_a_query_for_more_is_done():
    query = DataBlockType(
        "MpAlarmXQuery",
        [Member(name, BOOL, section=Section.INPUT) for name in ("Enable", "Execute", "Next")]
        + [Member("CommandDone", BOOL, section=Section.OUTPUT)],
    )
    assert (
        table_body(query, built_in_rules().of(query.name)).text
        == "CommandDone follows Execute or Next"
    )
