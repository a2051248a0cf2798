"""Library AsSem: counting semaphores. No call waits: the scan is one thread."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from plcsim.library.assem import interface
from plcsim.library.assem.interface import (
    semERR_ALREADY_FREE,
    semERR_CREATE,
    semERR_DELETE,
    semERR_NOT_EXIST,
    semERR_NOT_FREE,
)
from plcsim.library.block import SynchronousBlock
from plcsim.library.executable import function
from plcsim.library.idents import Idents
from plcsim.library.runtime import ERR_OK

if TYPE_CHECKING:
    from plcsim.core.context import Context


@dataclass(slots=True)
class Semaphore:
    """How often a semaphore can be taken at most, and now."""

    most: int
    free: int


class Semaphores(Idents[Semaphore]):
    """The semaphores of a controller."""


class SemCreate(interface.SemCreate, SynchronousBlock):
    """Make a semaphore that can be taken initCount times now and maxCount times at most.

    Inputs: enable, initCount, maxCount. Outputs: status, ident. Statuses: ERR_OK, semERR_CREATE.
    """

    def step(self) -> int:
        """Make it."""
        semaphores = self.context.library(Semaphores)
        if not self.maxCount or self.initCount > self.maxCount or semaphores.full:
            return semERR_CREATE
        self.ident = semaphores.add(Semaphore(self.maxCount, self.initCount))
        return ERR_OK


class SemDelete(interface.SemDelete, SynchronousBlock):
    """Delete a semaphore. Inputs: enable, ident. Output: status (ERR_OK, semERR_DELETE)."""

    def step(self) -> int:
        """Delete it."""
        found = self.context.library(Semaphores).remove(self.ident)
        return semERR_DELETE if found is None else ERR_OK


class SemGetInfo(interface.SemGetInfo, SynchronousBlock):
    """Counts of a semaphore. Inputs: enable, ident. Outputs: status, maxCount, curCount."""

    def step(self) -> int:
        """Look at it."""
        found = self.context.library(Semaphores).find(self.ident)
        if found is None:
            return semERR_NOT_EXIST
        self.maxCount, self.curCount = found.most, found.free
        return ERR_OK


@function("SemAcquire")
def acquire(context: Context, ident: int) -> int:
    """Take a semaphore; return ERR_OK, semERR_NOT_EXIST or semERR_NOT_FREE."""
    found = context.library(Semaphores).find(ident)
    if found is None:
        return semERR_NOT_EXIST
    if not found.free:
        return semERR_NOT_FREE
    found.free -= 1
    return ERR_OK


@function("SemRelease")
def release(context: Context, ident: int) -> int:
    """Give a semaphore back; return ERR_OK, semERR_NOT_EXIST or semERR_ALREADY_FREE."""
    found = context.library(Semaphores).find(ident)
    if found is None:
        return semERR_NOT_EXIST
    if found.free == found.most:
        return semERR_ALREADY_FREE
    found.free += 1
    return ERR_OK
