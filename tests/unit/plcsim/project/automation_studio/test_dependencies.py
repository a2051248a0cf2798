from pathlib import Path

from plcsim.project.automation_studio.dependencies import wrong_dependencies
from plcsim.project.automation_studio.logical_view import Dependency, SourceFolder


def library(name, *needed):
    lines = (Dependency(each, number) for number, each in enumerate(needed, 5))
    folder = Path(name)
    return SourceFolder(name, (name,), folder, (), folder / "IEC.lby", (), tuple(lines))


def texts(*libraries):
    return [str(each) for each in wrong_dependencies(libraries)]


def test_needed_libraries_are_found_in_any_case():
    assert texts(library("A", "b", "C"), library("B", "c"), library("c")) == []


def test_a_library_that_is_needed_and_not_there_is_told_with_its_line():
    assert texts(library("A", "B", "Gone"), library("B")) == [
        "A/IEC.lby:6: warning: library Gone is needed and not there"
    ]


def test_libraries_that_need_each_other_in_a_circle_are_told_once():
    circle = library("A", "X", "B"), library("B", "C"), library("C", "a"), library("X")
    assert texts(*circle) == [
        "A/IEC.lby:6: warning: libraries need each other in a circle: A -> B -> C -> A"
    ]
    assert texts(library("A", "A")) == [
        "A/IEC.lby:5: warning: libraries need each other in a circle: A -> A"
    ]


def test_two_circles_are_two_warnings():
    both = library("A", "B"), library("B", "A"), library("C", "D"), library("D", "C", "A")
    assert len(texts(*both)) == 2
