"""For tests of projects, never imported at run time.

The pytest plugin (`plcsim.recorder.testing.plugin`) brings the fixture ``recorder``, a
`RecorderFixture`: golden runs, and recordings of a machine as tests.
"""

from typing import TYPE_CHECKING

from plcsim.core.lazy import lazy_names

if TYPE_CHECKING:
    from plcsim.recorder.testing.recorder import RecorderFixture

__all__ = ["RecorderFixture"]

__getattr__ = lazy_names(__name__, {"RecorderFixture": "plcsim.recorder.testing.recorder"})
