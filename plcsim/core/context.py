"""What function blocks and programs of one controller work with."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar, cast

from plcsim.core.system_area import DATE, RELEASE
from plcsim.core.traffic import Traffic

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from plcsim.core.memory import Memory
    from plcsim.core.task import Violation

T = TypeVar("T")


class Context:
    """The surroundings of the programs of one controller.

    Args:
        memory: where all variables lie.
        network: see below.
        settings: objects that `settings` answers, one of a class.

    Attributes:
        memory: where all variables lie.
        network: what blocks that communicate talk over; `plcsim.network.network_of` gives it.
        traffic: messages that programs send and receive, told to whoever follows them.
        globals: a view of the global variables; None where the project has none.
        run_block: runs a function block whose body is not in Python; given by who knows libraries.
        violation: the violation an exception program was called for, None before the first.
    """

    __slots__ = (
        "_libraries",
        "_settings",
        "_system",
        "globals",
        "memory",
        "network",
        "run_block",
        "traffic",
        "violation",
    )

    def __init__(
        self,
        memory: Memory,
        network: object,
        settings: Iterable[object] = (),
    ) -> None:
        self.memory = memory
        self.network = network
        self.globals: Any = None
        self.run_block: Callable[[Any], None] = _no_body
        self._system = memory.system.cells
        self.violation: Violation | None = None
        self.traffic = Traffic()
        self._settings = {type(value): value for value in settings}
        self._libraries: dict[object, object] = {}

    @property
    def release_ns(self) -> int:
        """Release time of the running task class, nanoseconds on the controller's clock.

        It is the only time a function block knows, so all timers of a cycle agree. The scan sets it
        before the first program of a cycle runs; compiled code reads the same cell.
        """
        return self._system[RELEASE]

    @release_ns.setter
    def release_ns(self, time_ns: int) -> None:
        self._system[RELEASE] = time_ns

    @property
    def date_ns(self) -> int:
        """Date and time of the controller, nanoseconds since 1970-01-01 (UTC), at the release.

        It stands still within a cycle, as the release time does; setting it sets the controller's
        clock.
        """
        return self._system[RELEASE] + self._system[DATE]

    @date_ns.setter
    def date_ns(self, date_ns: int) -> None:
        self._system[DATE] = date_ns - self._system[RELEASE]

    def settings(self, kind: type[T]) -> T | None:
        """Return the settings of this class, None where the project has none.

        Libraries have them from tables [library.NAME] of plc.toml, extensions give theirs.
        """
        return cast("T | None", self._settings.get(kind))

    def give_settings(self, value: object) -> None:
        """Keep settings for those who ask for them by their class."""
        self._settings[type(value)] = value

    def library(self, factory: Callable[[Context], T]) -> T:
        """Return a library's state of this controller, made by ``factory`` at the first call.

        Blocks keep what cannot lie in PLC memory there: the sockets behind the idents, for example.
        """
        state = self._libraries.get(factory)
        if state is None:
            state = self._libraries[factory] = factory(self)
        return cast("T", state)

    def libraries(self) -> tuple[Any, ...]:
        """Return the states made so far."""
        return tuple(self._libraries.values())

    def restart(self) -> None:
        """Forget the states of all libraries; those with a ``close`` method are closed first.

        The last violation is forgotten too; the date is kept.
        """
        for state in self.libraries():
            if hasattr(state, "close"):
                state.close()
        self._libraries.clear()
        self.violation = None


def _no_body(block: object) -> None:
    raise NotImplementedError(f"{type(block).__name__} has no execute method.")
