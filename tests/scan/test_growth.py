"""A long run does not grow, whatever happens in its cycles."""

import gc
import tracemalloc

from plcsim.core.task import Policy
from st_types import UINT, var

MS = 1_000_000
CYCLES = 2000
ALLOWED = 4096
"""Bytes; what lists and integers of a few bytes more may take."""


def test_thousands_of_cycles_with_violations_and_inputs_take_no_more_memory(
    make_controller, task_class, program_of, clock
):
    def cyclic(program):
        program.count += 1
        clock.spend_ns(11 * MS)
        clock.stall_ns(program.count % 3 * MS)

    settings = {"policy": Policy.EXCEPTION, "host_policy": Policy.LOG}
    controller = make_controller(
        task_class(1, 10, settings, p=program_of(cyclic, count=var(UINT))),
        task_class(2, 50, settings, q=program_of(cyclic, count=var(UINT))),
        exception_program=program_of(count=var(UINT)),
    )
    tag = controller.tags.find("q.count")
    controller.image.inputs.append(lambda _: controller.tags.write(tag, 7))
    controller.boot()
    controller.run(cycles=CYCLES)
    tracemalloc.start()
    try:
        controller.run(cycles=CYCLES)
        gc.collect()
        before, _ = tracemalloc.get_traced_memory()
        controller.run(cycles=2 * CYCLES)
        gc.collect()
        after, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert sum(controller.classes[0].violations.values()) > CYCLES
    assert after - before < ALLOWED
