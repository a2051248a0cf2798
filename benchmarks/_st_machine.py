"""A state machine of any length, in Structured Text and in C: as large programs are."""

from __future__ import annotations

from _st_kernels import Text

LINES_PER_STATE = 20

STATE_ST = """\
	{n}:
		(* state {n} *)
		timer{n} := timer{n} + 1;
		output{n} := (timer{n} > limit) AND NOT alarm;
		position{n} := position{n} + speed * 0.01;
		IF position{n} > 100.0 THEN
			position{n} := 0.0;
			rounds := rounds + 1;
		END_IF
		IF timer{n} MOD 8 = 3 THEN
			limit := limit + 1;
			IF limit > 50 THEN
				limit := 5;
				alarm := NOT alarm;
			END_IF
		ELSE
			level := level + UDINT_TO_REAL(timer{n}) * 0.5 - position{n};
		END_IF
		state := {next};
"""

STATE_C = """\
	case {n}:
		v.timer{n} = v.timer{n} + 1;
		v.output{n} = (v.timer{n} > v.limit) & (v.alarm ^ 1);
		v.position{n} = v.position{n} + v.speed * 0.01;
		if (v.position{n} > 100.0) {{
			v.position{n} = 0.0f;
			v.rounds = v.rounds + 1;
		}}
		if (v.timer{n} % 8 == 3) {{
			v.limit = v.limit + 1;
			if (v.limit > 50) {{
				v.limit = 5;
				v.alarm = v.alarm ^ 1;
			}}
		}} else {{
			v.level = v.level + (float)v.timer{n} * 0.5 - v.position{n};
		}}
		v.state = {next};
		break;
"""

VARIABLES = """\
	timer{n} : UDINT;
	position{n} : REAL;
	output{n} : BOOL;
"""

COMMON = """\
	state : UINT;
	limit : UDINT := 5;
	rounds : UDINT;
	speed : REAL := 12.5;
	level : REAL;
	alarm : BOOL;
"""


def state_machine(lines: int, cycles: int = 1) -> Text:
    """Return a program with a CASE of about that many lines, which goes through all states."""
    count = max(2, lines // LINES_PER_STATE)
    numbers = [{"n": n, "next": (n + 1) % count} for n in range(count)]
    variables = "".join(VARIABLES.format(**one) for one in numbers)
    st = "".join(STATE_ST.format(**one) for one in numbers)
    c = "".join(STATE_C.format(**one) for one in numbers)
    return Text(
        f"states{lines}",
        {"Variables.var": f"VAR\n{COMMON}{variables}END_VAR\n"},
        {"Main.st": f"PROGRAM _CYCLIC\n\tCASE state OF\n{st}\tEND_CASE\nEND_PROGRAM\n"},
        f"void cyclic(void)\n{{\n\tswitch (v.state) {{\n{c}\t}}\n}}\n",
        cycles,
    )
