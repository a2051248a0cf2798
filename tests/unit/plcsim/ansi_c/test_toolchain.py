import os
import stat

import pytest

from plcsim.ansi_c import toolchain as module
from plcsim.core.errors import ConfigurationError


@pytest.fixture
def nothing_installed(monkeypatch, tmp_path):
    """An empty path, and no package ``ziglang``; returns a folder on the path."""
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(module, "find_spec", lambda _name: None)
    for function in module.zig, module.system_clang:
        function.cache_clear()
    yield tmp_path
    for function in module.zig, module.system_clang:
        function.cache_clear()


def install(folder, name, target=None):
    """Put a program on the path, by way of a link as Debian does."""
    file = folder / (target or name)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("#!/bin/sh\n")
    file.chmod(stat.S_IRWXU)
    if target:
        (folder / name).symlink_to(file)


def test_without_a_compiler_the_one_command_is_told(nothing_installed):
    with pytest.raises(ConfigurationError, match=r"pip install 'plcsim\[c\]'"):
        module.find_toolchain()


def test_a_clang_without_its_linker_is_none(nothing_installed):
    install(nothing_installed, "clang")
    install(nothing_installed, "clang++")
    assert module.system_clang() is None


def test_the_newest_numbered_clang_is_taken(nothing_installed):
    for number in 14, 16:
        for name in "clang", "clang++", "wasm-ld":
            install(nothing_installed, f"{name}-{number}", f"llvm-{number}/bin/{name}")
    found = module.find_toolchain()
    assert found.name == "clang 16"
    assert found.c[0] == str(nothing_installed / "clang-16")
    assert "--unresolved-symbols=import-dynamic" in found.linker


def test_the_oldest_linker_does_without_the_option_that_it_does_not_know(nothing_installed):
    for name in "clang", "clang++", "wasm-ld":
        install(nothing_installed, f"{name}-14", f"llvm-14/bin/{name}")
    found = module.find_toolchain()
    assert (found.name, len(found.linker)) == ("clang 14", 1)


def test_a_clang_that_is_too_old_is_none(nothing_installed):
    for name in "clang", "clang++", "wasm-ld":
        install(nothing_installed, name, f"llvm-9/bin/{name}")
    assert module.system_clang() is None


def test_a_replaced_compiler_is_another_one(nothing_installed):
    for name in "clang", "clang++", "wasm-ld":
        install(nothing_installed, name, f"llvm-15/bin/{name}")
    before = module.find_toolchain().identity
    os.utime(nothing_installed / "llvm-15/bin/clang", ns=(1, 1))
    module.system_clang.cache_clear()
    assert module.find_toolchain().identity != before


def test_the_user_s_c_setup_takes_no_part(each_toolchain, monkeypatch):
    monkeypatch.setenv("CPATH", "/somewhere")
    assert "CPATH" not in each_toolchain.environment()
    assert each_toolchain.environment()["PATH"] == os.environ["PATH"]
