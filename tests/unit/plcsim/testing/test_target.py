"""What is run: projects loaded afresh, program classes."""

import sys

import pytest

from plcsim import Program
from plcsim.core.errors import ConfigurationError
from plcsim.testing import PlcTestError, open_plc
from plcsim.testing.target import find_project, project_target
from st_types import DINT, var


class Counter(Program):
    n = var(DINT)

    def cyclic(self):
        self.n += 1


def test_a_project_is_found_from_its_tests(project):
    (project / "tests" / "deep").mkdir(parents=True)
    assert find_project(project / "tests" / "deep") == project


def test_no_project(tmp_path):
    with pytest.raises(PlcTestError, match=r"no plc.toml in .* or above it"):
        find_project(tmp_path)


def test_modules_of_a_project_are_forgotten_afterwards(project):
    before = set(sys.modules)
    with open_plc(project) as plc:
        plc.cycles(3)
        assert plc["cell.count"] == 3
        assert {m for m in set(sys.modules) - before if m.startswith("plcsim_project_")}
    assert not {m for m in set(sys.modules) - before if m.startswith("plcsim_project_")}


def test_module_variables_of_a_program_are_fresh_in_each_test(project):
    (project / "cell" / "main.py").write_text(
        "from plcsim import Program\nfrom st_types import DINT, var\nseen = []\n"
        "class P(Program):\n    n = var(DINT)\n"
        "    def cyclic(self):\n        seen.append(1)\n        self.n = len(seen)\n"
    )
    for _ in range(2):
        with open_plc(project) as plc:
            plc.cycles(3)
            assert plc["cell.n"] == 3


def test_a_broken_project_leaves_nothing_behind(project):
    (project / "cell" / "main.py").write_text("import plcsim\n1 / 0\n")
    with pytest.raises(ConfigurationError, match=r"main.py:2: division by zero"):
        project_target(project)


def test_program_classes_run_without_a_project():
    with open_plc(program=[Counter], cycle="2ms") as plc:
        plc.run("10ms")
        assert plc["Counter.n"] == 5


@pytest.mark.parametrize("given", [{}, {"project": "x", "program": Counter}])
def test_a_project_or_a_program_is_needed(given):
    with pytest.raises(PlcTestError, match="either a project or a program"), open_plc(**given):
        pass


def test_a_wrong_cycle_time():
    with (
        pytest.raises(PlcTestError, match="cycle: 'fast' is not a duration"),
        open_plc(program=Counter, cycle="fast"),
    ):
        pass
