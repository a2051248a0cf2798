"""The process image between processes: snapshots out, commands in, and nobody waits for the scan.

`ImageWriter` lives in the scan process, `ImageReader` in a service process (or in the same process,
in virtual time). Between them lies one file mapping: a directory of the programs' variables, two
banks that hold the last two snapshots, and one ring of commands for each service.
"""

from plcsim.shared_image.command import Command, Mask, Scatter, Store
from plcsim.shared_image.directory import Directory
from plcsim.shared_image.errors import CommandRefused, ImageError, ImageNotReady
from plcsim.shared_image.reader import ImageReader, ScanWatch
from plcsim.shared_image.writer import ImageWriter

__all__ = [
    "Command",
    "CommandRefused",
    "Directory",
    "ImageError",
    "ImageNotReady",
    "ImageReader",
    "ImageWriter",
    "Mask",
    "ScanWatch",
    "Scatter",
    "Store",
]
