"""Regular expressions mean the same on every Python that plcsim runs on."""

import importlib
import pkgutil
import re
import warnings
from collections.abc import Iterator
from types import ModuleType

import pytest

import crosnode
import plcsim
import st_types

PACKAGES = (st_types, plcsim, crosnode)


def modules() -> Iterator[ModuleType]:
    for package in PACKAGES:
        for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not found.name.endswith("__main__"):
                yield importlib.import_module(found.name)


def patterns() -> dict[str, re.Pattern[str]]:
    return {
        f"{module.__name__}.{name}": value
        for module in modules()
        for name, value in vars(module).items()
        if isinstance(value, re.Pattern)
    }


def operators(pattern: re.Pattern[str]) -> str:
    """Return the operators of a parsed expression, as text."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        parser = importlib.import_module("re._parser")
    return str(parser.parse(pattern.pattern, pattern.flags))


def test_there_are_some() -> None:
    assert len(patterns()) > 10


@pytest.mark.parametrize("text", ["a*+", "(?>a|b)c"])
def test_what_is_looked_for_is_seen(text: str) -> None:
    assert re.search("POSSESSIVE|ATOMIC", operators(re.compile(text)))


def test_none_is_possessive() -> None:
    """Python before 3.11.5 takes those and atomic groups wrongly (python/cpython issue 106052)."""
    found = [name for name, p in patterns().items() if re.search("POSSESSIVE|ATOMIC", operators(p))]
    assert found == []
