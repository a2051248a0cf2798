"""Blocks that open and use serial interfaces, and find none."""

from __future__ import annotations

from plcsim.library.block import SynchronousBlock
from plcsim.library.dvframe import interface
from plcsim.library.dvframe.interface import frmERR_DEVICEDESCRIPTION, frmERR_NOTOPENED


class FRM_xopen(interface.FRM_xopen, SynchronousBlock):  # noqa: N801  # the controller's name
    """Open an interface: there is none of this name. Status frmERR_DEVICEDESCRIPTION."""

    def step(self) -> int:
        """Look for it."""
        return frmERR_DEVICEDESCRIPTION


class FRM_mode(interface.FRM_mode, SynchronousBlock):  # noqa: N801  # the controller's name
    """Change the mode of an interface: none is open. Status frmERR_NOTOPENED."""

    def step(self) -> int:
        """Look for it."""
        return frmERR_NOTOPENED


class FRM_ctrl(interface.FRM_ctrl, SynchronousBlock):  # noqa: N801  # the controller's name
    """Set control lines: none is open. Status frmERR_NOTOPENED."""

    def step(self) -> int:
        """Look for it."""
        return frmERR_NOTOPENED


class FRM_gbuf(interface.FRM_gbuf, SynchronousBlock):  # noqa: N801  # the controller's name
    """Take a buffer for sending: none is open. Status frmERR_NOTOPENED."""

    def step(self) -> int:
        """Look for it."""
        return frmERR_NOTOPENED


class FRM_robuf(interface.FRM_robuf, SynchronousBlock):  # noqa: N801  # the controller's name
    """Give a buffer for sending back: none is open. Status frmERR_NOTOPENED."""

    def step(self) -> int:
        """Look for it."""
        return frmERR_NOTOPENED


class FRM_write(interface.FRM_write, SynchronousBlock):  # noqa: N801  # the controller's name
    """Send a buffer: none is open. Status frmERR_NOTOPENED."""

    def step(self) -> int:
        """Look for it."""
        return frmERR_NOTOPENED


class FRM_writeAcknowledged(interface.FRM_writeAcknowledged, SynchronousBlock):  # noqa: N801  # the controller's name
    """Send a buffer, and know that it went: none is open. Status frmERR_NOTOPENED."""

    def step(self) -> int:
        """Look for it."""
        return frmERR_NOTOPENED


class FRM_read(interface.FRM_read, SynchronousBlock):  # noqa: N801  # the controller's name
    """Receive a buffer: none is open. Status frmERR_NOTOPENED."""

    def step(self) -> int:
        """Look for it."""
        return frmERR_NOTOPENED


class FRM_rbuf(interface.FRM_rbuf, SynchronousBlock):  # noqa: N801  # the controller's name
    """Give a received buffer back: none is open. Status frmERR_NOTOPENED."""

    def step(self) -> int:
        """Look for it."""
        return frmERR_NOTOPENED


class FRM_close(interface.FRM_close, SynchronousBlock):  # noqa: N801  # the controller's name
    """Close an interface: none is open. Status frmERR_NOTOPENED."""

    def step(self) -> int:
        """Look for it."""
        return frmERR_NOTOPENED
