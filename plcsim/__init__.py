"""Simulated PLC: task classes on a tick, function blocks, tags and networks."""
