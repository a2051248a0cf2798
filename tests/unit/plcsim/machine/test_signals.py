import subprocess
import sys

import pytest

SOURCE = """
import faulthandler, wasmtime
from plcsim.core.memory import PAGE, Memory
from plcsim.machine import CodeCache, Machine, MachineFault

TEXT = '''(module (import "env" "memory" (memory 0))
    (func (export "unreachable") unreachable)
    (func (export "nil") (drop (i32.load (i32.const 0)))))'''

def trap():
    machine = Machine(Memory(PAGE), cache=CodeCache(None))
    instance = machine.instantiate(machine.compile(bytes(wasmtime.wat2wasm(TEXT))), {})
    for name in ("unreachable", "nil"):
        try:
            instance.function(name)()
        except MachineFault as fault:
            print(fault)

trap()
REPLACED
trap()
"""


@pytest.mark.parametrize(
    "replaced",
    [
        "faulthandler.disable()",
        "faulthandler.disable(); faulthandler.enable()",
        "import signal; signal.signal(signal.SIGILL, signal.SIG_DFL)",
    ],
)
def test_faults_are_faults_after_the_handlers_were_taken_away(replaced):
    """In a process of its own: a failure ends it."""
    source = SOURCE.replace("REPLACED", replaced)
    command = [sys.executable, "-c", source]
    result = subprocess.run(command, check=False, capture_output=True, text=True)
    texts = ["unreachable code", "page fault: address 16#00000000"]
    assert result.stdout.splitlines() == texts * 2, result.stderr
