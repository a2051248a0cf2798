"""What `plcsim new` adds to a copy of an example: all keys as comments, settings of tools."""

from __future__ import annotations

import re

from plcsim.core.duration import format_duration, parse_duration_ns

PLC_KEYS = """\
# Keys in comments have their default; docs/project.md tells more of them.

# [plc]
# name = "{name}"  # shown in tables and reports; by default the folder's name
# tick = "1ms"  # all cycle times are multiples of it
# memory = "16MiB"  # PLC memory for variables
# watchdog = "500ms"  # a CYCLIC that has not returned after this time is ended
# init_timeout = "10s"  # the same for INIT and EXIT
# realtime = "auto"  # real-time rights: "auto", "off" or "require"
# priority = 50  # of SCHED_FIFO, 1 to 98
# cpu = -1  # processor of the scan; -1 for the last one that is free
# exception_program = "..."  # a program that runs for violations under the policy "exception"
# dialect = ""  # of Structured Text: "iec", "automation-studio", "" for what each file tells
# start_date = 2026-03-31T06:00:00  # date of the controller at its start; by default the host's

"""

TASK_CLASS_KEYS = """\
# tolerance = "{cycle}"  # how much longer a cycle may take; by default the cycle time
# first_release = "{half}"  # from the start of the scan; by default half the cycle time
# on_violation = "service"  # "service", "log" or "exception", for violations by programs
# on_host_violation = "log"  # the same for violations by the host
"""

GITIGNORE = """\
__pycache__/
.pytest_cache/
.mypy_cache/
/report/
"""

PYTEST_INI = """\
[pytest]
# Test files of several projects may have the same name.
addopts = --import-mode=importlib
"""

MYPY_INI = """\
[mypy]
# The project's folder is a package, {name}: from ..shared import X
mypy_path = $MYPY_CONFIG_FILE_DIR/..
packages = {name}
"""

_CLASS = re.compile(r'\[task_class\.\d\]\n(?:.+\n)*?cycle = "(?P<cycle>[^"]+)".*\n(?:.+\n)*')


def commented(plc_toml: str, name: str) -> str:
    """Return a plc.toml with the keys that it does not use as comments.

    Args:
        plc_toml: of an example.
        name: of the new project.
    """
    head, table, rest = plc_toml.partition("\n[")
    text = f"{head}\n{PLC_KEYS.format(name=name)}{table[1:]}{rest}"
    return _CLASS.sub(lambda found: found[0] + _class_keys(found), text)


def _class_keys(found: re.Match[str]) -> str:
    """Return the keys that a table [task_class.N] does not have."""
    half = format_duration(parse_duration_ns(found["cycle"]) // 2)
    text = TASK_CLASS_KEYS.format(cycle=found["cycle"], half=half.replace(" ", ""))
    lines = text.splitlines(keepends=True)
    return "".join(line for line in lines if f"\n{line.split()[1]} =" not in found[0])
