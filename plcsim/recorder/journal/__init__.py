"""The journal: all that comes into a controller from outside, cycle by cycle.

A run depends on nothing but what its clock, its network and writers outside gave it. While it is
recorded, `RecordedClock` and `RecordedNetwork` note every answer; in a replay `ReplayClock` and
`ReplayNetwork` give the same answers in the same order.
"""
