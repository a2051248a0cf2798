"""Errors of plcsim.doctor.

::

    PlcError
    └── MeasurementError      a loop could not be run, or gave no figures
"""

from __future__ import annotations

from plcsim.core.errors import PlcError


class MeasurementError(PlcError):
    """A loop could not be measured; the message names the loop and says why."""
