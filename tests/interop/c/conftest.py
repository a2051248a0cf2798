"""Compilers of the host beside those of units, and sources of others."""

import contextlib
import shutil
import subprocess
import sys
import tarfile

import pytest

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.headers import INCLUDE
from plcsim.ansi_c.module import CModule
from plcsim.ansi_c.toolchain import find_toolchain, system_clang, zig
from plcsim.core.errors import ConfigurationError
from plcsim.core.memory import PAGE, Memory
from plcsim.machine import CodeCache, Machine
from plcsim.machine.shared_module import read_shared

LONGEST_DOWNLOAD_S = 400
GCC = ("gcc", "-m32", "-msse2", "-mfpmath=sse", "-ffp-contract=off", "-fno-strict-aliasing")


def _download(command, folder):
    """Download; once more where the index has said no at first, but not where it took too long."""
    with contextlib.suppress(subprocess.CalledProcessError):
        subprocess.run(command.split(), cwd=folder, timeout=LONGEST_DOWNLOAD_S, check=True)
        return
    subprocess.run(command.split(), cwd=folder, timeout=LONGEST_DOWNLOAD_S, check=True)


class _CLibraryAlone:
    """Surroundings of sources that need functions of C and nothing else."""

    def __init__(self, machine):
        from plcsim.ansi_c.c_library import CLibrary

        self._library = CLibrary(machine)

    def variable(self, name):
        return self._library.variable(name)

    def function(self, name, _wanted=None):
        return self._library.extern(name)


@pytest.fixture(params=[zig, system_clang], ids=["zig", "clang"])
def unit_results(request, tmp_path):
    """``unit_results(text, count)``: what ``fill(unsigned *)`` writes, by each compiler."""
    toolchain = request.param()
    if toolchain is None:
        pytest.skip("this compiler for units is not installed")

    def unit_results(text, count):
        file = tmp_path / "unit.c"
        file.write_text(text)
        built = build(BuildOrder("unit", [file], [INCLUDE]), toolchain, CodeCache(None))
        memory = Memory(64 * PAGE)
        machine = Machine(memory)
        area = memory.allocate(4 * count, 4)
        module = CModule("unit", read_shared(built.wasm), machine, _CLibraryAlone(machine)).link()
        module.reset()
        module.function("fill")(area)
        data = memory.read(area, 4 * count)
        machine.close()
        return [int.from_bytes(data[i : i + 4], "little") for i in range(0, len(data), 4)]

    return unit_results


@pytest.fixture
def host_results(tmp_path):
    """``host_results(text, count, "-O2")``: the same of a program of 32 bits by gcc."""
    if shutil.which("gcc") is None:
        pytest.skip("gcc is not installed")

    def host_results(text, count, *options):
        main = (
            "#include <stdio.h>\nvoid fill(unsigned *);\n"
            f"static unsigned results[{count}];\n"
            "int main(void)\n{\n\tfill(results);\n"
            f"\tfor (int i = 0; i < {count}; i++)\n"
            '\t\tprintf("%u\\n", results[i]);\n\treturn 0;\n}\n'
        )
        (tmp_path / "host.c").write_text(text)
        (tmp_path / "host_main.c").write_text(main)
        command = [*GCC, *options, "-o", "host", "host.c", "host_main.c", "-lm"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        if done.returncode and "cannot find" in done.stderr + done.stdout:
            pytest.skip("gcc -m32 is not here (package gcc-multilib)")
        if done.returncode and "No such file" in done.stderr:
            pytest.skip("gcc -m32 is not here (package gcc-multilib)")
        assert done.returncode == 0, done.stderr
        told = subprocess.run([tmp_path / "host"], capture_output=True, text=True, check=True)
        return [int(line) for line in told.stdout.split()]

    return host_results


@pytest.fixture(scope="session")
def sources_of(pytestconfig):
    """``sources_of("package==1.0")``: the folder with its source distribution, fetched once."""

    def sources_of(package):
        try:
            find_toolchain()
        except ConfigurationError:
            pytest.skip("no compiler for C is installed")
        folder = pytestconfig.cache.mkdir(package.partition("==")[0])
        fetch = f"{sys.executable} -m pip download -q --no-deps --no-binary :all: {package}"
        if not [*folder.glob("*.tar.gz")]:
            try:
                _download(fetch, folder)
            except (subprocess.SubprocessError, OSError) as error:
                pytest.skip(f"the package index cannot be reached: {error}")
        (archive,) = folder.glob("*.tar.gz")
        with tarfile.open(archive) as content:
            content.extractall(folder, filter="data")
        return folder

    return sources_of
