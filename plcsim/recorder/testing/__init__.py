"""For tests of projects, never imported at run time.

The pytest plugin (`plcsim.recorder.testing.plugin`) brings the fixture ``recorder``, a `Recorder`:
golden runs, and recordings of a machine as tests.
"""

from typing import TYPE_CHECKING

from plcsim.core.lazy import lazy_names

if TYPE_CHECKING:
    from plcsim.recorder.testing.recorder import Recorder

__all__ = ["Recorder"]

__getattr__ = lazy_names(__name__, {"Recorder": "plcsim.recorder.testing.recorder"})
