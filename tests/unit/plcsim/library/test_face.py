"""Faces: what Python sees of a library's declarations."""

from enum import IntEnum

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import (
    InterfaceModule,
    declared_beside,
    face_of,
    forget,
    give_members,
    library_of,
    names_of,
    register,
)
from plcsim.library.library import Library
from plcsim.library.standard import TON
from st_types import REAL, Struct
from st_types.types.derived import EnumerationType
from st_types.types.views import type_of


@pytest.fixture
def interface(library):
    """The module ``interface`` of the library, made when it is asked for."""
    return InterfaceModule(library)


def test_a_block_is_a_class_with_the_type_of_its_declaration(library, interface):
    ramp = interface.Ramp
    assert issubclass(ramp, FunctionBlock)
    assert type_of(ramp) is library.scope.find_type("Ramp")
    assert ramp.__module__ == "ramp_lib.interface"
    view = ramp()
    assert (view.Step, view.axis.speed, view.name) == (3, 1.5, "")
    with pytest.raises(AttributeError):
        view.stp = 1


def test_a_face_is_made_once(interface):
    assert interface.Ramp is interface.Ramp
    assert interface.Axis is interface.Axis


def test_a_block_inside_is_the_one_of_its_library(interface):
    assert isinstance(interface.Ramp().timer, TON)


def test_structs_enumerations_other_types_and_constants(interface):
    assert issubclass(interface.Axis, Struct)
    assert interface.Axis(speed=2.5).speed == 2.5
    assert issubclass(interface.Mode, IntEnum)
    assert interface.Mode.RUNNING == 5
    assert interface.Speed.size == REAL.size
    assert (interface.STEP, interface.NAME) == (3, "ramp")


def test_a_name_that_is_not_declared_gets_the_one_that_was_meant(interface):
    with pytest.raises(AttributeError, match=r"ramps declares no Stp; did you mean STEP\?"):
        _ = interface.Stp
    with pytest.raises(AttributeError, match="declares no TON"):
        _ = interface.TON  # of another library
    with pytest.raises(AttributeError, match="declares no instances"):
        _ = interface.instances  # a variable has no value here


def test_all_names_are_listed(library, interface):
    expected = ["Axis", "Mode", "NAME", "Ramp", "STEP", "Speed", "twice"]
    assert sorted(names_of(library.scope)) == dir(interface) == expected


def test_an_enumeration_that_python_cannot_have_stays_a_number():
    for names in ({"mro": 1}, {"_x_": 2, "__y__": 3}):
        data_type = EnumerationType("E", names)
        assert give_members(data_type) is None
        assert data_type.members is None


def test_a_body_takes_the_place_of_its_face(library, interface):
    class Ramp(interface.Ramp):
        pass

    data_type = library.scope.find_type("Ramp")
    assert type_of(Ramp) is data_type
    assert data_type.view is Ramp
    assert face_of(library.scope, "Ramp", "x") is Ramp


def test_the_library_of_a_module_is_found_by_its_package(library):
    assert library_of("ramp_lib") is library
    assert library_of("plcsim.library.standard").name == "standard"
    inner = Library(library.folder, "ramp_lib.inner")
    register(inner)
    forget("ramp_lib")
    for package in ("ramp_lib", "ramp_lib.inner"):
        with pytest.raises(ConfigurationError, match=f"{package}: is not the folder of a library"):
            library_of(package)


def test_what_an_interface_file_says_is_compared_with_the_declarations(library):
    declared = declared_beside("ramp_lib.interface")
    assert declared["Axis"] is library.scope.find_type("Axis")
    declared.enumeration(IntEnum("Mode", {"IDLE": 0, "RUNNING": 5}))
    assert library.scope.find_type("Mode").members.RUNNING == 5
    wrong = r"interface\.py: {} is not as ramps declares it; write the file anew: plcsim types lib"
    for name in ("Gone", "Mode", "TON"):
        with pytest.raises(ConfigurationError, match=wrong.format(name)):
            _ = declared[name]
    with pytest.raises(ConfigurationError, match=wrong.format("Mode")):
        declared.enumeration(IntEnum("Mode", {"IDLE": 1, "RUNNING": 5}))
