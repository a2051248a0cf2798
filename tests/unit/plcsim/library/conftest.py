"""Folders that are libraries."""

import textwrap

import pytest

from plcsim.library import face
from plcsim.library.installed import Scopes, installed
from plcsim.library.library import Library

FILES = {
    "ramps.fun": """
        FUNCTION_BLOCK Ramp (*goes up*)
            VAR_INPUT
                Enable : BOOL; (*run*)
                Step : UDINT := STEP;
                axis : Axis;
            END_VAR
            VAR_OUTPUT
                Out : ARRAY[1..2] OF UDINT; (*where it is*)
                mode : Mode;
            END_VAR
            VAR
                timer : TON;
                name : STRING[9];
                level : REAL;
            END_VAR
        END_FUNCTION_BLOCK
        FUNCTION twice : UDINT
            VAR_INPUT
                x : UDINT;
            END_VAR
        END_FUNCTION
    """,
    "ramps.typ": """
        TYPE
            Axis : STRUCT (*one axis*)
                speed : REAL := 1.5; (*m/s*)
                pName : UDINT;
            END_STRUCT;
            Mode : (IDLE, RUNNING := 5);
            Speed : REAL;
        END_TYPE
    """,
    "ramps.var": """
        VAR CONSTANT
            STEP : UDINT := 3; (*of a ramp*)
            NAME : STRING[5] := 'ramp';
        END_VAR
        VAR
            instances : UDINT;
        END_VAR
    """,
}


@pytest.fixture
def files(tmp_path):
    """``files({name: text})``: a folder ``ramp_lib`` with the library of this module, and these."""

    def files(more=None):
        folder = tmp_path / "ramp_lib"
        folder.mkdir(exist_ok=True)
        for name, text in (FILES | (more or {})).items():
            (folder / name).write_text(textwrap.dedent(text), "utf-8")
        return folder

    return files


@pytest.fixture
def library(files):
    """The library of this module, which sees the installed ones."""
    made = Library(files(), "ramp_lib", Scopes([*installed().values()]))
    face.register(made)
    yield made
    face.forget("ramp_lib")
