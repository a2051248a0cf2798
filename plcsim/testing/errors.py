"""Errors of plcsim.testing.

::

    PlcTestError                     the test asks for what cannot be (a PlcError)
    ├── StimulusError                a list or file of stimuli is wrong; names line and column
    └── PlantError                   a plant model raised; names it, the cycle and file:line
    ExpectationFailed                what a test expected did not happen (an AssertionError)
    └── ControllerFault              the controller went into SERVICE
"""

from __future__ import annotations

from plcsim.core.errors import PlcError


class PlcTestError(PlcError):
    """The test asks for what cannot be; the message says it in the test's own terms."""


class StimulusError(PlcTestError):
    """A list or file of stimuli is wrong; the message names line and column."""


class PlantError(PlcTestError):
    """A plant model, or an act that the test planned, raised."""


class ExpectationFailed(AssertionError):  # noqa: N818  # reads as the result of a test
    """What a test expected did not happen.

    The message is one line. The last cycles of the tags involved, as a table and as a timing
    diagram, are its note (PEP 678), so pytest and a plain traceback show them below it.

    Attributes:
        tags: paths of the tags involved.
    """

    def __init__(self, text: str, tags: tuple[str, ...] = (), details: str = "") -> None:
        super().__init__(text)
        self.tags = tags
        if details:
            self.add_note(details)


class ControllerFault(ExpectationFailed):
    """A program failed or violated its cycle time: the controller is in SERVICE."""
