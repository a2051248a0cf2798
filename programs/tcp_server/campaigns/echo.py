"""Is a byte ever lost, whatever the latency, the sizes of sends, and resets?

plcsim campaign programs/tcp_server/campaigns/echo.py
"""

from random import Random

from plcsim.campaign import Campaign, Integer, LatinHypercube
from plcsim.campaign.variables import Scalar
from plcsim.testing import Plc

ECHO_PORT = 22012
OTHER_IP = "192.168.0.21"

campaign = Campaign(
    variables={
        "latency_ms": Integer(0, 200),
        "largest_send": Integer(1, 200, nominal=200),
        "reset_ms": Integer(0, 400),
        "size": Integer(1, 2000),
    },
    sampling=LatinHypercube(100),
)


@campaign.scenario
def echo(plc: Plc, values: dict[str, Scalar]) -> dict[str, Scalar]:
    """Send bytes and get them back; the connection of another client is reset meanwhile."""
    data = Random(int(values["size"])).randbytes(int(values["size"]))  # noqa: S311  # repeatable
    plc["echo_server.address"] = ""  # clients come from other hosts
    plc.run("10ms")  # until it listens
    plc.faults.latency(f"{values['latency_ms']}ms")
    plc.faults.short_sends(int(values["largest_send"]))
    plc.faults.reset(OTHER_IP, at=f"{values['reset_ms']}ms")
    client, other = plc.connect(ECHO_PORT), plc.connect(ECHO_PORT, OTHER_IP)
    client.send(data)
    other.send(data)
    took_ns = plc.until(lambda: len(client.received) >= len(data), within="20s")
    assert client.received == data, "the echo differs"
    return {"took_ms": took_ns / 1e6, "served": plc["echo_server.served"]}
