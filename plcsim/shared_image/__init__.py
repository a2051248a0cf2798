"""The process image between processes: snapshots and streams out, commands in.

Nobody waits for the scan, and the scan for nobody. `ImageWriter` lives in the scan process,
`ImageReader` in a service process (or in the same process, in virtual time). Between them lies one
file mapping: a directory of the variables, two banks that hold the last two snapshots, the list of
forced tags, a stream of what happens, and for each service a ring of commands and a stream of the
samples it asked for.
"""

from plcsim.shared_image.command import (
    Answer,
    Cancel,
    Command,
    CommandOutcome,
    Control,
    Follow,
    ForceCommand,
    Mask,
    Release,
    SampleCommand,
    Scatter,
    StoreCommand,
    Write,
)
from plcsim.shared_image.directory import Directory
from plcsim.shared_image.errors import CommandRefused, ImageError, ImageNotReady
from plcsim.shared_image.reader import ImageReader, ScanWatch
from plcsim.shared_image.writer import ImageWriter

__all__ = [
    "Answer",
    "Cancel",
    "Command",
    "CommandOutcome",
    "CommandRefused",
    "Control",
    "Directory",
    "Follow",
    "ForceCommand",
    "ImageError",
    "ImageNotReady",
    "ImageReader",
    "ImageWriter",
    "Mask",
    "Release",
    "SampleCommand",
    "ScanWatch",
    "Scatter",
    "StoreCommand",
    "Write",
]
