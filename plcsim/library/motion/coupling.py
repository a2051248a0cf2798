"""How an axis follows another one: by a ratio, from here on or by way of a synchronous position."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from plcsim.library.motion.axis import Axis


class Approach(NamedTuple):
    """A way into synchronism: a straight line over the positions of the master.

    Attributes:
        master: position of the master at which both are synchronous.
        slave: position that the slave has then.
        distance: of the master before that over which the slave gets there; 0 is the whole way
            from the command on.
    """

    master: float
    slave: float
    distance: float = 0.0


class Followed(NamedTuple):
    """Where the slave is.

    Attributes:
        position: of it.
        velocity: of it.
        is_synchronous: whether it has the ratio.
    """

    position: float
    velocity: float
    is_synchronous: bool


class Coupling:
    """Follows a master, from where both are now.

    Args:
        master: that is followed.
        ratio: of the velocities, slave to master.
        slave: position of the slave now.
        approach: the way into synchronism; a master that is beyond it is followed at once.

    Attributes:
        master: as above.
    """

    def __init__(
        self, master: Axis, ratio: float, slave: float, approach: Approach | None = None
    ) -> None:
        self.master = master
        self._ratio = ratio
        self._origin, self._slave = master.position, slave
        is_ahead = approach is not None and approach.master > master.position
        self._approach = approach if is_ahead else None

    def at(self) -> Followed:
        """Return where the slave is, for the position that the master has."""
        master, approach = self.master.position, self._approach
        if approach is not None and master < approach.master:
            return self._approaching(master, approach)
        if approach is not None:
            self._origin, self._slave, self._approach = approach.master, approach.slave, None
        position = self._slave + self._ratio * (master - self._origin)
        return Followed(position, self._ratio * self.master.velocity, is_synchronous=True)

    def _approaching(self, master: float, approach: Approach) -> Followed:
        start = self._origin
        if approach.distance > 0:
            start = max(start, approach.master - approach.distance)
        slope = (approach.slave - self._slave) / (approach.master - start)
        way = master - start
        if way <= 0:
            return Followed(self._slave, 0.0, is_synchronous=False)
        position = self._slave + slope * way
        return Followed(position, slope * self.master.velocity, is_synchronous=False)
