"""Replay: a recorded run again, cycle by cycle, on the program as it is now."""
