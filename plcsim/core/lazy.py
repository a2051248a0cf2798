"""Names of a package that are imported when they are first used.

The pytest plugin lies inside plcsim, so every run of pytest on a machine with plcsim imports the
package. That must cost nothing where no test asks for a PLC, and must not load a module before
coverage measurement of it has begun.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


def lazy_names(package: str, places: Mapping[str, str]) -> Callable[[str], object]:
    """Return the ``__getattr__`` of a package (PEP 562).

    Args:
        package: its ``__name__``.
        places: for each public name the module that defines it.
    """

    def load(name: str) -> object:
        if name not in places:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return getattr(import_module(places[name]), name)

    return load
