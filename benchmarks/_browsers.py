"""Browsers that watch 200 tags ten times a second; one of them traces 8 tags in every cycle.

python _browsers.py PORT COUNT

Prints "ready" when all of them see values, and when stdin is closed one line of JSON: messages/s of
a browser, samples of the trace, how many are missing by their cycle numbers, and how many the
page says are lost.
"""

from __future__ import annotations

import asyncio
import json
import struct
import sys
import time
from typing import Final

from websockets.asyncio.client import ClientConnection, connect

TAGS: Final = 200
TRACED: Final = 8
WATCHED: Final = [f"line.fast[{index}]" for index in range(TAGS)]
TRACE: Final = ["line.cycle", *WATCHED[: TRACED - 1]]


class Browser:
    """A browser; the one that traces keeps the cycle numbers of its samples."""

    def __init__(self, port: int, *, traces: bool) -> None:
        self._port = port
        self._traces = traces
        self.messages = 0
        self.sees = asyncio.Event()
        self.cycles: list[int] = []
        self.lost = 0

    async def run(self) -> None:
        """Look until cancelled."""
        url, origin = f"ws://127.0.0.1:{self._port}/live", f"http://127.0.0.1:{self._port}"
        async with connect(url, origin=origin, max_size=None, compression="deflate") as socket:
            await socket.send(json.dumps({"id": 1, "do": "watch", "tags": WATCHED}))
            if self._traces:
                await socket.send(json.dumps({"id": 2, "do": "trace", "tags": TRACE}))
            await self._listen(socket)

    async def _listen(self, socket: ClientConnection) -> None:
        while True:
            message = await socket.recv()
            if isinstance(message, bytes):
                _, count, _, self.lost = struct.unpack_from("<IIII", message)
                cycles = struct.unpack_from(f"<{count}d", message, 16 + 8 * count)
                self.cycles += map(int, cycles)
            elif json.loads(message).get("push") == "values":
                self.messages += 1
                self.sees.set()

    @property
    def missing(self) -> int:
        """Cycles between the first and the last that have no sample; -1 where there is none."""
        return self.cycles[-1] - self.cycles[0] + 1 - len(self.cycles) if self.cycles else -1


async def main(port: int, count: int) -> None:
    """Be all browsers, and print what they saw."""
    browsers = [Browser(port, traces=number == 0) for number in range(count)]
    async with asyncio.TaskGroup() as group:
        tasks = [group.create_task(browser.run()) for browser in browsers]
        for browser in browsers:
            await browser.sees.wait()
        print("ready", flush=True)
        before, started_s = [browser.messages for browser in browsers], time.monotonic()
        await asyncio.to_thread(sys.stdin.read)
        took_s = time.monotonic() - started_s
        for task in tasks:
            task.cancel()
    tracing = browsers[0]
    found = {
        "updates_per_s": min(
            (browser.messages - first) / took_s
            for browser, first in zip(browsers, before, strict=True)
        ),
        "samples": len(tracing.cycles),
        "missing": tracing.missing,
        "lost": tracing.lost,
    }
    print(json.dumps(found))


if __name__ == "__main__":
    asyncio.run(main(int(sys.argv[1]), int(sys.argv[2])))
