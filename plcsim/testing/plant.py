"""Plant models: what the programs control, stepped with the scan."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from plcsim.testing.errors import PlcTestError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.testing.tags import Tags

__tracebackhide__ = True


class PlantStep(Protocol):
    """A function that steps a plant, or the method ``step`` of an object."""

    def __call__(self, tags: Tags, elapsed_ns: int, /) -> Mapping[str, object] | None:
        """Advance the plant.

        Args:
            tags: outputs of the programs are read from it, inputs written to it.
            elapsed_ns: time since the last step.

        Returns:
            Inputs to be written, by tag; None where all were written to ``tags``.
        """


class Plant:
    """A plant model on a controller, stepped in the LATCH of a task class."""

    def __init__(self, model: object, tags: Tags, start_ns: int) -> None:
        self.name = getattr(model, "__name__", type(model).__name__)
        self._step = _step_of(model)
        self._tags = tags
        self._last_ns = start_ns

    def step(self, time_ns: int) -> None:
        """Advance the plant to a time since the start of the controller."""
        elapsed_ns, self._last_ns = max(0, time_ns - self._last_ns), time_ns
        for path, value in (self._step(self._tags, elapsed_ns) or {}).items():
            self._tags[path] = value

    def restart(self) -> None:
        """Time starts at 0 again."""
        self._last_ns = 0


def _step_of(model: object) -> Callable[[Tags, int], Mapping[str, object] | None]:
    step: Callable[[Tags, int], Mapping[str, object] | None] | None
    step = getattr(model, "step", None) or (model if callable(model) else None)
    if isinstance(model, type) or not callable(step):
        raise PlcTestError(
            f"{model!r} is no plant: give a function of (tags, elapsed_ns), "
            "or an object with such a method called step"
        )
    return step
