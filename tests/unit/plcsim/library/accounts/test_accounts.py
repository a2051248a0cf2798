"""ArUser: users, roles and lists of them."""

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.accounts.accounts import (
    ALREADY_EXISTS,
    DOES_NOT_EXIST,
    END_OF_LIST,
    MOST_LISTS,
    PARAMETER,
)
from plcsim.library.accounts.blocks import BLOCKS
from plcsim.library.members import BlockVariables, StructMembers
from st_types import BOOL, BYTE, DINT, UDINT
from st_types.types.derived import DataBlockType, Member, Section, StringType, StructType

TEXT = StringType(128)
LIST = StructType("ArUserIdentType", [Member("Handle", UDINT), Member("MagicNumber", UDINT)])
NAMES = ("UserName", "RoleName", "Password", "ElementName", "PropertyName", "PropertyValue")
IMMEDIATE = ("ArUserGetFirst", "ArUserGetNext")


class Users:
    """A controller; ``users.do("ArUserCreate", UserName="Ann")`` runs a block to its end."""

    def __init__(self):
        self.context = Context(Memory(), None)
        self.blocks = {}

    def block(self, name):
        if name not in self.blocks:
            inputs = {**dict.fromkeys(NAMES, TEXT), "ListType": BYTE, "ElementType": BYTE}
            inputs |= {"List": LIST, "Execute": BOOL}
            outputs = {"ErrorID": DINT} | dict.fromkeys(
                ("Done", "Error", "IsAuthentic", "HasRole"), BOOL
            )
            if name not in IMMEDIATE:
                outputs["Busy"] = BOOL
            data_type = DataBlockType(
                name,
                [Member(each, kind, section=Section.INPUT) for each, kind in inputs.items()]
                + [Member(each, kind, section=Section.OUTPUT) for each, kind in outputs.items()],
            )
            memory = self.context.memory
            address = memory.allocate(data_type.size)
            variables = BlockVariables(memory, StructMembers(data_type), address)
            self.blocks[name] = (variables, BLOCKS[name](data_type, self.context, {}.get))
        return self.blocks[name]

    def call(self, name, **inputs):
        variables, model = self.block(name)
        variables.set(**inputs)
        model.run(variables.start)
        names = ("Busy", "Done", "Error")
        return {each for each in names if variables.is_true(each)}, variables

    def do(self, name, **inputs):
        """Return ErrorID."""
        self.call(name, Execute=False)
        on, variables = self.call(name, Execute=True, **inputs)
        if name not in IMMEDIATE:
            assert on == {"Busy"}
            on, variables = self.call(name)
        assert on == {"Error" if variables.number("ErrorID") else "Done"}
        return variables.number("ErrorID")

    def names(self, **inputs):
        """Go through a list as programs do."""
        assert self.do("ArUserInitList", **inputs) == 0
        handle = self.block("ArUserInitList")[0].number("List.Handle")
        found, name = [], "ArUserGetFirst"
        while self.do(name, List__Handle=handle) == 0:
            found.append(self.block(name)[0].own_text("ElementName"))
            name = "ArUserGetNext"
        assert self.block(name)[0].number("ErrorID") == END_OF_LIST
        return found


@pytest.fixture
def users():
    return Users()


def test_users_are_made_listed_and_deleted(users):
    assert users.names(ListType=1) == []
    for name in ("Ann", "Bob"):
        assert users.do("ArUserCreate", UserName=name) == 0
    assert users.do("ArUserCreate") == ALREADY_EXISTS
    assert users.do("ArUserCreate", UserName="") == PARAMETER
    assert users.names(ListType=1) == ["Ann", "Bob"]
    assert users.do("ArUserDelete", UserName="Ann") == 0
    assert users.do("ArUserDelete") == DOES_NOT_EXIST
    assert users.names(ListType=1) == ["Bob"]


def test_done_stays_as_long_as_execute(users):
    assert users.call("ArUserCreate", Execute=True, UserName="Ann")[0] == {"Busy"}
    assert users.call("ArUserCreate", Execute=False)[0] == {"Done"}
    assert users.call("ArUserCreate")[0] == set()
    users.do("ArUserCreate", UserName="Bob")
    assert users.call("ArUserCreate")[0] == {"Done"}


def test_passwords_of_known_users_are_compared(users):
    def is_authentic(name, password):
        assert users.do("ArUserAuthenticatePassword", UserName=name, Password=password) == 0
        return users.block("ArUserAuthenticatePassword")[0].is_true("IsAuthentic")

    users.do("ArUserCreate", UserName="Ann")
    assert is_authentic("Ann", "")
    assert users.do("ArUserSetPassword", UserName="Ann", Password="one") == 0
    assert [is_authentic("Ann", each) for each in ("one", "two")] == [True, False]
    assert is_authentic("Operator", "any")
    assert users.do("ArUserSetPassword", UserName="Operator") == DOES_NOT_EXIST


def test_roles(users):
    def has_role(role):
        assert users.do("ArUserHasRole", UserName="Ann", RoleName=role) == 0
        return users.block("ArUserHasRole")[0].is_true("HasRole")

    users.do("ArUserCreate", UserName="Ann")
    assert users.do("ArUserCreateRole", RoleName="Service") == 0
    for role in ("Service", "Setter", "Setter"):
        assert users.do("ArUserAssignRole", UserName="Ann", RoleName=role) == 0
    assert users.names(ListType=2) == ["Service", "Setter"]
    assert users.names(ListType=3, ElementName="Ann") == ["Service", "Setter"]
    assert users.do("ArUserReleaseRole", UserName="Ann", RoleName="Service") == 0
    assert users.do("ArUserReleaseRole") == DOES_NOT_EXIST
    assert [has_role(each) for each in ("Service", "Setter")] == [False, True]
    assert users.do("ArUserAssignRole", UserName="Bob") == DOES_NOT_EXIST


@pytest.mark.parametrize(("kind", "list_type"), [(1, 5), (2, 4)])
def test_properties(users, kind, list_type):
    users.do("ArUserCreate", UserName="Ann")
    users.do("ArUserCreateRole", RoleName="Ann")
    given = {"ElementType": kind, "ElementName": "Ann", "PropertyName": "Level"}
    assert users.do("ArUserGetProperty", **given) == DOES_NOT_EXIST
    assert users.do("ArUserSetProperty", **given, PropertyValue="3") == 0
    assert users.do("ArUserGetProperty", **given) == 0
    assert users.block("ArUserGetProperty")[0].own_text("PropertyValue") == "3"
    assert users.names(ListType=list_type, ElementName="Ann") == ["Level"]
    assert users.do("ArUserGetProperty", ElementType=3) == PARAMETER
    assert users.do("ArUserSetProperty", ElementName="Bob") == DOES_NOT_EXIST


def test_lists_that_are_none(users):
    assert users.do("ArUserInitList", ListType=9) == PARAMETER
    assert users.do("ArUserInitList", ListType=3, ElementName="Ann") == DOES_NOT_EXIST
    assert users.do("ArUserGetFirst", List__Handle=1) == PARAMETER


def test_a_list_is_as_it_was_and_old_ones_make_room(users):
    users.do("ArUserCreate", UserName="Ann")
    users.do("ArUserInitList", ListType=1)
    users.do("ArUserDelete", UserName="Ann")
    assert users.do("ArUserGetFirst", List__Handle=1) == 0
    assert users.block("ArUserGetFirst")[0].own_text("ElementName") == "Ann"
    for _ in range(MOST_LISTS):
        users.do("ArUserInitList", ListType=1)
    assert users.do("ArUserGetFirst", List__Handle=1) == PARAMETER
    assert users.do("ArUserGetFirst", List__Handle=2) == END_OF_LIST
