"""Library sys_lib: tasks, variables by name, memory, errors and the clock.

What is declared and has no body here belongs to older controllers: data modules, mailboxes,
semaphores and user tasks of their own, a display, a keypad.
"""

from plcsim.library.sys_lib.interface import *  # noqa: F403  # its types and constants
