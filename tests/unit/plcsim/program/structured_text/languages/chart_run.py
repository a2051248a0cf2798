"""Charts that run cycle by cycle on a clock of their own."""

from ..running import Running

CLOCK = "FUNCTION clock_ms : TIME END_FUNCTION\n"


class RunningChart(Running):
    """A program with a chart; each cycle comes 10 ms after the one before."""

    def __init__(self, text, declarations=""):
        self.time_ms = 990
        super().__init__(text, CLOCK + declarations, clock_ms=lambda _self: self.time_ms)

    def cycles(self, count=1):
        for _ in range(count):
            self.time_ms += 10
            self.run()
        return self

    def active(self, *steps):
        return " ".join(step for step in steps if self[f"{step}.X"])


def chart(text, declarations=""):
    return RunningChart(f"PROGRAM _CYCLIC\n{text}\nEND_PROGRAM", declarations)
