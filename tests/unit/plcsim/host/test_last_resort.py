"""A process whose code does not return from a call into C is ended, and it is told where."""

import os
import subprocess
import sys
import time

ENDLESS = """
import sys
from itertools import repeat
from pathlib import Path
from plcsim.host.last_resort import last_resort
with last_resort(0, Path(sys.argv[1]), "does not return"): all(repeat(1))
"""

ENDLESS_CALL = """
import sys
from pathlib import Path
from plcsim.host import last_resort
last_resort.PATIENCE_S = 0.02
with last_resort.last_resort(10**12, Path(sys.argv[1]), "was left alone"):
    pass
sys.path.insert(0, sys.argv[1])
import endless
"""


def run(text, *arguments, **options):
    return subprocess.run(
        [sys.executable, "-c", text, *arguments],
        stderr=subprocess.PIPE,
        text=True,
        timeout=60,
        check=False,
        **options,
    )


def test_the_line_is_told_and_the_process_ends(tmp_path):
    folder = tmp_path / 'größe "1"'
    folder.mkdir()
    module = folder / "endless.py"
    module.write_text(ENDLESS)
    done = run(ENDLESS_CALL, str(folder), env={**os.environ, "PYTHONIOENCODING": "utf-8"})
    assert done.stderr == f"plcsim: {module}:6: does not return\n"
    assert done.returncode == 1


def test_it_is_told_where_it_is_asked_for(tmp_path):
    other = os.memfd_create("errors")
    (tmp_path / "endless.py").write_text(ENDLESS.replace('return")', f'return", {other})'))
    done = run(ENDLESS_CALL, str(tmp_path), pass_fds=(other,))
    deadline = time.monotonic() + 60
    while not (told := os.pread(other, 1000, 0).decode()) and time.monotonic() < deadline:
        time.sleep(0.01)  # the reader tells it after the process has ended
    os.close(other)
    assert (done.stderr, told) == ("", f"plcsim: {tmp_path}/endless.py:6: does not return\n")


WITHOUT_LIMIT = """
import sys
from pathlib import Path
from plcsim.host import last_resort
sys.settrace(lambda *_: None)
with last_resort.last_resort(10**12, Path("/"), "does not return"):
    assert not last_resort._readers
"""


def test_who_is_debugged_is_left_alone():
    assert run(WITHOUT_LIMIT).stderr == ""


KILLED_READER = """
import os, signal, sys
from pathlib import Path
from plcsim.host import last_resort
for _ in range(2):
    with last_resort.last_resort(10**12, Path("/"), "does not return"):
        pass
    (reader,) = map(int, Path(f"/proc/self/task/{os.getpid()}/children").read_text().split())
    os.kill(reader, signal.SIGKILL)
    os.waitpid(reader, 0)
"""


def test_a_reader_that_was_ended_is_started_again():
    done = run(KILLED_READER)
    assert (done.returncode, done.stderr) == (0, "")
