"""Measures whether a host can hold a tick: facts of the host, three loops on one grid, a verdict.

`plcsim.doctor.host` reads what the kernel tells, `plcsim.doctor.loops` runs our own scan loop
beside a bare C loop and a bare Python loop, `plcsim.doctor.verdict` says in words what the figures
mean and what would make them better.
"""
