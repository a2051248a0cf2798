"""MpUserXLogin: who is logged in."""

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.mapp.user_blocks import BLOCKS, NOBODY_LEVEL, USER_LEVEL
from plcsim.library.members import BlockVariables, StructMembers
from st_types import BOOL, DINT, UDINT
from st_types.types.derived import (
    ArrayType,
    DataBlockType,
    EnumerationType,
    Member,
    ReferenceType,
    Section,
    StringType,
    WStringType,
)

RIGHT = EnumerationType("MpUserXAccessRightEnum", {f"ACCESS_{n}": n for n in range(5)})
COMMANDS = ("Enable", "ErrorReset", "Login", "Logout")


class Login:
    """A block of one kind of texts; a call returns the outputs."""

    def __init__(self, context, text):
        self._text, self._memory = text, context.memory
        inputs = {"MpLink": UDINT, "UserName": ReferenceType(text)} | dict.fromkeys(COMMANDS, BOOL)
        outputs = {
            **dict.fromkeys(("Active", "Error", "CommandBusy", "CommandDone"), BOOL),
            **dict.fromkeys(("StatusID", "CurrentLevel"), DINT),
            "CurrentUser": text,
            "AccessRights": ArrayType(RIGHT, [(0, 1)]),
        }
        data_type = DataBlockType(
            "MpUserXLogin",
            [Member(each, kind, section=Section.INPUT) for each, kind in inputs.items()]
            + [Member(each, kind, section=Section.OUTPUT) for each, kind in outputs.items()],
        )
        self._variables = BlockVariables(
            self._memory, StructMembers(data_type), self._memory.allocate(data_type.size)
        )
        self._run = BLOCKS["MpUserXLogin"](data_type, context, {}.get).run

    def name(self, text):
        address = self._memory.allocate(self._text.size)
        self._memory.set(self._text, address, text)
        return address

    def __call__(self, **inputs):
        self._variables.set(**inputs)
        self._run(self._variables.start)
        place = self._variables.place("CurrentUser")
        user = self._memory.get(self._text, place)
        return user, self._variables.number("CurrentLevel"), self.on

    @property
    def on(self):
        names = ("Active", "Error", "CommandBusy", "CommandDone")
        return {each for each in names if self._variables.is_true(each)}

    @property
    def rights(self):
        return [self._variables.element("AccessRights", index) for index in range(2)]


@pytest.fixture
def context():
    return Context(Memory(), None)


@pytest.fixture(params=[WStringType(20), StringType(20)], ids=["WSTRING", "STRING"])
def login(context, request):
    made = Login(context, request.param)
    made(Enable=True, MpLink=1)
    return made


def test_who_logs_in_is_known_until_he_logs_out(login):
    assert login() == ("", NOBODY_LEVEL, {"Active"})
    assert login.rights == [1, 1]
    busy = login(Login=True, UserName=login.name("Ann"))
    assert busy == ("", NOBODY_LEVEL, {"Active", "CommandBusy"})
    assert login() == ("Ann", USER_LEVEL, {"Active", "CommandDone"})
    assert login.rights == [4, 4]
    assert login(Login=False) == ("Ann", USER_LEVEL, {"Active"})
    login(Logout=True)
    assert login() == ("", NOBODY_LEVEL, {"Active", "CommandDone"})


def test_without_a_name_nobody_logs_in(login):
    login(Login=True)
    assert login() == ("", NOBODY_LEVEL, {"Active", "CommandDone"})


def test_blocks_with_one_link_know_one_user(context, login):
    other = Login(context, WStringType(20))
    other(Enable=True, MpLink=1)
    login(Login=True, UserName=login.name("Ann"))
    login()
    assert other()[0] == "Ann"
    third = Login(context, WStringType(20))
    assert third(Enable=True, MpLink=2)[0] == ""
