"""The controller library CrosNode: the node for programs in Structured Text and C.

Its functions are those of the thesis, with handles in place of pointers. Programs in Python have
the node itself (`crosnode.plc.project.create_node`).
"""

from crosnode.interface.interface import *  # noqa: F403  # its types and constants
