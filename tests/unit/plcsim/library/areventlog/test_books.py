"""Logbooks."""

import pytest

from plcsim.library.areventlog import (
    arEVENTLOG_ERR_IDENT_INVALID,
    arEVENTLOG_ERR_IDENT_SYSTEM,
    arEVENTLOG_ERR_INTERNAL,
    arEVENTLOG_ERR_LOGBOOK_EXISTS,
    arEVENTLOG_ERR_LOGBOOK_NOT_FOUND,
    arEVENTLOG_ERR_NAME_INVALID,
    arEVENTLOG_ERR_PERSISTENCE_INVAL,
    arEVENTLOG_ERR_SIZE_INVALID,
)
from plcsim.library.areventlog.books import (
    ArEventLogCreate,
    ArEventLogDelete,
    ArEventLogGetIdent,
)


def test_a_logbook_is_made_found_and_deleted(do):
    made = do(ArEventLogCreate, Name="mine", Size=1000)
    assert made.Done
    assert do(ArEventLogGetIdent, Name="mine").Ident == made.Ident
    again = do(ArEventLogCreate, Name="mine", Size=1000)
    assert (again.StatusID, again.Ident) == (arEVENTLOG_ERR_LOGBOOK_EXISTS, made.Ident)
    assert do(ArEventLogDelete, Ident=made.Ident).Done
    assert do(ArEventLogGetIdent, Name="mine").StatusID == arEVENTLOG_ERR_LOGBOOK_NOT_FOUND
    assert do(ArEventLogDelete, Ident=made.Ident).StatusID == arEVENTLOG_ERR_IDENT_INVALID


@pytest.mark.parametrize("name", ["$arlogsys", "$arlogusr"])
def test_logbooks_that_are_always_there(do, name):
    ident = do(ArEventLogGetIdent, Name=name).Ident
    assert ident
    assert do(ArEventLogDelete, Ident=ident).StatusID == arEVENTLOG_ERR_IDENT_SYSTEM


@pytest.mark.parametrize(
    ("inputs", "status"),
    [
        ({"Name": ""}, arEVENTLOG_ERR_NAME_INVALID),
        ({"Size": 10}, arEVENTLOG_ERR_SIZE_INVALID),
        ({"Size": 2**30}, arEVENTLOG_ERR_SIZE_INVALID),
        ({"Persistence": 3}, arEVENTLOG_ERR_PERSISTENCE_INVAL),
    ],
)
def test_logbooks_that_cannot_be(do, inputs, status):
    made = do(ArEventLogCreate, **{"Name": "mine", "Size": 1000} | inputs)
    assert (made.StatusID, made.Ident) == (status, 0)


def test_there_is_an_end_of_logbooks(do):
    found = [do(ArEventLogCreate, Name=f"log {n}", Size=100).StatusID for n in range(31)]
    assert found == [0] * 30 + [arEVENTLOG_ERR_INTERNAL]
