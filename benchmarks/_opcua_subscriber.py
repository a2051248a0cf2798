"""A client of OPC UA: 20 subscriptions of 100 variables each.

python _opcua_subscriber.py PORT PROJECT

Prints "ready" when it has them, and when stdin is closed one line of JSON: changes/s that came.
"""

from __future__ import annotations

import asyncio
import json
import sys
import time
from typing import Any, Final

SUBSCRIPTIONS: Final = 20
ITEMS: Final = 100
PUBLISHING_MS: Final = 100


class _Counter:
    count = 0

    def datachange_notification(self, *_: Any) -> None:
        self.count += 1


async def subscribe(port: int, project: str) -> None:
    """Subscribe to ``line.values[0].v`` and those after it, and count until stdin is closed."""
    from asyncua import Client, ua  # noqa: PLC0415  # a benchmark imports the numbers above

    counter = _Counter()
    client = Client(f"opc.tcp://127.0.0.1:{port}", timeout=60, watchdog_intervall=30)
    async with client:
        index = await client.get_namespace_index(f"urn:plcsim:{project}")
        for number in range(SUBSCRIPTIONS):
            subscription = await client.create_subscription(PUBLISHING_MS, counter)
            first = number * ITEMS
            nodes = [
                client.get_node(ua.NodeId(f"line.values[{first + i}].v", index))
                for i in range(ITEMS)
            ]
            await subscription.subscribe_data_change(nodes)
        print("ready", flush=True)
        before, started_s = counter.count, time.monotonic()
        await asyncio.to_thread(sys.stdin.read)
        took_s = time.monotonic() - started_s
        print(json.dumps({"changes_per_s": (counter.count - before) / took_s}))


if __name__ == "__main__":
    asyncio.run(subscribe(int(sys.argv[1]), sys.argv[2]))
