"""Blocks that read and write registers and objects of devices on a bus, none of which is there."""
