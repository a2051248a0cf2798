"""Regular expressions mean the same on every Python that plcsim runs on."""

import importlib
import os
import pkgutil
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType

import pytest

import crosnode
import plcsim
import st_types

PACKAGES = (st_types, plcsim, crosnode)


@contextmanager
def is_without_its_extra() -> Iterator[None]:
    """Pass over a module whose extra is not installed; in CI all are."""
    try:
        yield
    except ModuleNotFoundError as err:
        is_own = (err.name or "").partition(".")[0] in {package.__name__ for package in PACKAGES}
        if is_own or os.environ.get("PLCSIM_INTEROP") == "required":
            raise


def modules() -> Iterator[ModuleType]:
    for package in PACKAGES:
        for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not found.name.endswith("__main__"):
                with is_without_its_extra():
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
