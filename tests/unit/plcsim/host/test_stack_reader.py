"""What the stack of faulthandler tells."""

import json

from plcsim.host.stack_reader import location_in, message

STACK = """\
Timeout (0:00:04)!
Thread 0x00007f6f0f1b5740 (most recent call first):
  File "/usr/lib/python3.11/re/__init__.py", line 166 in match
  File "/home/anna/cell/main/main.py", line 3 in <module>
  File "/home/anna/cell/globals.py", line 9 in <module>
""".splitlines(keepends=True)


def order(folder):
    return f"{json.dumps([folder, 'does not return'])}\n"


def test_the_innermost_frame_of_the_project_is_told():
    assert location_in(STACK, "/home/anna/cell") == "/home/anna/cell/main/main.py:3"
    assert location_in(STACK, "/home/anna/ce") == ""


def test_a_path_that_is_not_ascii_is_found():
    folder = "/größe\t1 \\n € 😀"
    written = "/gr\\xf6\\xdfe\\x091 \\n \\u20ac \\U0001f600"
    stack = [f'  File "{written}/main.py", line 7 in <module>\n']
    assert location_in(stack, folder) == f"{folder}/main.py:7"


def test_the_last_order_says_what_is_told():
    lines = [order("/other"), order("/home/anna/cell"), *STACK]
    assert message(lines) == "plcsim: /home/anna/cell/main/main.py:3: does not return"
    assert message([order("/elsewhere"), *STACK]) == "plcsim: /elsewhere: does not return"


def test_a_process_that_ended_by_itself_is_no_news():
    assert message([order("/home/anna/cell")]) == message([]) == ""
