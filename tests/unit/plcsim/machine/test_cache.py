import os
import subprocess
import sys
from pathlib import Path

import pytest

from plcsim.core.memory import PAGE, Memory
from plcsim.machine import CodeCache, Machine
from plcsim.machine.cache import MAX_BYTES, default_folder, key_of
from plcsim.machine.engine import engine_of

from .units import assemble

ANSWER = '(func (export "answer") (result i32) (i32.const 42))'


@pytest.fixture
def cache(tmp_path):
    return CodeCache(tmp_path / "deep" / "code")


def entries(tmp_path):
    return sorted(file for file in tmp_path.rglob("*") if file.is_file())


def answer(cache):
    """Compile with a cache, as a process does that has not compiled before."""
    engine_of(fuel=False)._codes.clear()
    machine = Machine(Memory(PAGE), cache=cache)
    return machine.instantiate(machine.compile(assemble(ANSWER)), {}).function("answer")()


def test_what_is_stored_is_loaded(cache):
    assert cache.load("key") is None
    cache.store("key", b"code")
    assert cache.load("key") == b"code"
    cache.store("key", b"other")
    assert cache.load("key") == b"other"


def test_only_whole_entries_lie_in_the_folder(cache, tmp_path):
    cache.store("key", b"code" * 1000)
    assert [file.name for file in entries(tmp_path)] == ["key.code"]
    assert (tmp_path / "deep" / "code").stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: b"",
        lambda data: data[:-1],
        lambda data: data + b"\0",
        lambda data: data[:40] + bytes([data[40] ^ 1]) + data[41:],
        lambda data: bytes([data[0] ^ 1]) + data[1:],
        lambda data: b"foreign text",
    ],
)
def test_a_damaged_entry_is_compiled_again(cache, tmp_path, damage):
    assert answer(cache) == 42
    files = entries(tmp_path)
    for file in files:
        file.write_bytes(damage(file.read_bytes()))
    assert all(cache.load(file.stem) is None for file in files)
    assert answer(cache) == 42
    assert all(cache.load(file.stem) for file in files)


def test_an_entry_of_another_compiler_is_compiled_again(cache, tmp_path):
    assert answer(cache) == 42
    for file in entries(tmp_path):
        cache.store(file.stem, b"code of another version of wasmtime")
    assert answer(cache) == 42
    for file in entries(tmp_path):
        assert cache.load(file.stem) != b"code of another version of wasmtime"


def test_an_entry_of_another_user_is_not_run(cache, monkeypatch):
    cache.store("key", b"code")
    monkeypatch.setattr(os, "geteuid", lambda: 12345)
    owner = (cache._folder / "key.code").stat().st_uid
    assert cache.load("key") == (b"code" if owner == 0 else None)
    os.chown(cache._folder / "key.code", 54321, -1)
    assert cache.load("key") is None


@pytest.mark.parametrize("folder", ["/proc/no/such/place", "/dev/null/code", None])
def test_without_a_folder_everything_works(folder):
    cache = CodeCache(folder and Path(folder))
    assert answer(cache) == 42
    assert cache.load("key") is None


def test_a_folder_in_the_place_of_an_entry_does_no_harm(cache):
    (cache._folder / "key.code").mkdir(parents=True)
    cache.store("key", b"code")
    assert cache.load("key") is None
    assert [file.name for file in cache._folder.iterdir()] == ["key.code"]


def test_the_oldest_go_when_it_is_full(tmp_path):
    cache = CodeCache(tmp_path, max_bytes=1000)
    for place, key in enumerate("abc"):
        cache.store(key, bytes(268))
        os.utime(tmp_path / f"{key}.code", ns=(place, place))
    assert cache.load("a") is not None  # used now
    cache.store("d", bytes(268))
    assert sorted(file.stem for file in entries(tmp_path)) == ["a", "c", "d"]


def test_the_oldest_go_when_there_are_too_many(tmp_path):
    cache = CodeCache(tmp_path, max_bytes=1000, max_entries=2)
    for place, key in enumerate("abc"):
        cache.store(key, b"")
        os.utime(tmp_path / f"{key}.code", ns=(place, place))
    assert sorted(file.stem for file in entries(tmp_path)) == ["b", "c"]


def test_the_folder_is_not_looked_through_at_every_entry(tmp_path, monkeypatch):
    looks = []

    def look(cache):
        looks.append(cache)

    monkeypatch.setattr(CodeCache, "_shrink", look)
    for number in range(64):
        CodeCache(tmp_path, max_bytes=64_000, max_entries=64).store(str(number), b"")
    assert 4 <= len(looks) <= 17


def test_what_is_larger_than_the_cache_is_not_kept(tmp_path):
    cache = CodeCache(tmp_path, max_bytes=100)
    cache.store("key", bytes(100))
    assert entries(tmp_path) == []


def test_the_key_tells_module_and_settings_apart(monkeypatch):
    keys = {key_of(b"a", "s"), key_of(b"b", "s"), key_of(b"a", "t")}
    assert len(keys) == 3
    assert key_of(b"a", "s") == key_of(b"a", "s")
    assert all(len(key) == 48 and key.isalnum() for key in keys)


def test_engines_with_other_settings_do_not_share_entries(cache, tmp_path):
    wasm = assemble(ANSWER)
    for settings in ({"fuel": False}, {"fuel": True}, {"fuel": True, "compare": True}):
        engine = engine_of(**settings)
        engine._codes.clear()
        engine.compile(wasm, lambda: wasm, cache)
    assert len(entries(tmp_path)) == 3


def test_the_user_s_folder(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", "relative")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert default_folder() == tmp_path / ".cache" / "plcsim" / "code"
    monkeypatch.setattr("pathlib.Path.home", _no_home)
    assert default_folder() is None
    assert MAX_BYTES == 256 << 20


def _no_home():
    raise RuntimeError


STORES = """
import sys
from pathlib import Path
from plcsim.machine import CodeCache
cache = CodeCache(Path(sys.argv[1]), 40_000)
for turn in range(200):
    key = f"key{turn % 7}"
    found = cache.load(key)
    assert found in (None, key.encode() * 1000), found
    cache.store(key, key.encode() * 1000)
"""


def test_several_processes_use_one_folder(tmp_path):
    command = [sys.executable, "-c", STORES, str(tmp_path)]
    processes = [subprocess.Popen(command, stderr=subprocess.PIPE) for _ in range(3)]
    assert [(p.communicate()[1], p.returncode) for p in processes] == [(b"", 0)] * 3
    assert not [file for file in entries(tmp_path) if file.suffix != ".code"]
