"""Retained variables that outlive their process: the table [retain] of plc.toml.

The scan publishes them with every snapshot; a process of its own writes what has changed into two
files in turn. What the newer one holds is there again when the controller starts.
"""
