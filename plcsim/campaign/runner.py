"""The process that does runs, one after another: ``python -m plcsim.campaign.runner``.

Its parent is a worker of Dask, which has threads and must not hang; here a program may hang or
bring the process down, and the parent ends it or starts another. Orders come and results go over
a connection whose descriptor is an argument.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
import time
from dataclasses import replace
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.campaign.definition import load_campaign
from plcsim.campaign.single_run import SingleRun
from plcsim.core.errors import PlcError
from plcsim.host.realtime import die_with_parent

if TYPE_CHECKING:
    from plcsim.campaign.definition import Campaign

HELD_BACK = (signal.SIGINT,)
"""The parent starts this process with these signals blocked: Ctrl-C goes to all of its group, and
would end it while Python still imports."""


def main() -> None:
    """Do what is ordered until the parent goes."""
    file = Path(sys.argv[1])
    descriptor, parent = int(sys.argv[2]), int(sys.argv[3])
    die_with_parent(signal.SIGKILL, parent)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the parent
    signal.pthread_sigmask(signal.SIG_UNBLOCK, HELD_BACK)
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)  # what a program prints in ten thousand runs has no reader
    with Connection(descriptor) as parent_end:
        try:
            campaign = load_campaign(file)
        except PlcError as err:
            parent_end.send(str(err))
            return
        parent_end.send("")
        _serve(parent_end, campaign, file)


def _serve(parent: Connection, campaign: Campaign, file: Path) -> None:
    here = f"{Path.cwd()}{os.sep}"
    is_first = True
    while True:
        try:
            order = parent.recv()
        except (EOFError, OSError):
            return
        started = time.perf_counter()
        result = SingleRun(campaign, order).perform(file)
        host_s = time.perf_counter() - started
        message = result.message.replace(here, "")  # alike wherever the content was unpacked
        parent.send(replace(result, message=message, host_s=host_s, details=""))
        gc.collect()
        if is_first:
            gc.freeze()  # what the first run imported stays: later collections are about runs
            is_first = False


if __name__ == "__main__":
    main()
