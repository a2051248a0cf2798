"""Guests: a ring for a moment, given back however the guest ends."""

import os
import subprocess
import sys
import time

import pytest

from plcsim.shared_image import (
    CommandOutcome,
    CommandRefused,
    ImageReader,
    SampleCommand,
    StoreCommand,
    Write,
    layout,
)
from plcsim.shared_image.guest import guest, tidy

from .conftest import World


def file_of(world: World) -> str:
    return f"/proc/{os.getpid()}/fd/{world.fd}"


def test_a_guest_writes_beside_the_services(world: World) -> None:
    with guest(file_of(world)) as reader:
        ticket = reader.send(Write((StoreCommand(world.address("fast.word"), b"\7\0"),)))
        world.controller.run(cycles=1)
        assert reader.outcome(ticket) is CommandOutcome.APPLIED
    assert world.read("fast.word") == 7


def test_so_many_guests_have_room_and_their_places_are_given_back(world: World) -> None:
    first = guest(file_of(world))
    first.__enter__()
    others = [guest(file_of(world)) for _ in range(layout.GUESTS - 1)]
    for other in others:
        other.__enter__()
    with pytest.raises(CommandRefused, match="4 others"), guest(file_of(world)):
        pass
    first.__exit__(None, None, None)
    with guest(file_of(world)):
        pass
    for other in others:
        other.__exit__(None, None, None)


DIES = """
import sys, time
from plcsim.shared_image import SampleCommand
from plcsim.shared_image.guest import guest
with guest(sys.argv[1]) as reader:
    tag = reader.directory.find("fast.count")
    reader.send(SampleCommand(1, 0, 0, [(tag.address, 4)]))
    print("asked", flush=True)
    time.sleep(60)
"""


def test_the_samples_of_a_guest_that_was_killed_are_cancelled(world: World) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", DIES, file_of(world)], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "asked\n"
        world.controller.run(cycles=1)
        ring = 1
        assert world.reader.samples_of(ring) == 1
        tidy(world.reader, world.fd)
        world.controller.run(cycles=1)
        assert world.reader.samples_of(ring) == 1  # it lives
        process.kill()
        process.wait()
    deadline = time.monotonic() + 100
    while world.reader.samples_of(ring):
        assert time.monotonic() < deadline
        tidy(world.reader, world.fd)
        world.controller.run(cycles=1)


def test_a_new_guest_begins_without_the_samples_of_the_one_before(world: World) -> None:
    with guest(file_of(world)) as reader:
        reader.send(SampleCommand(1, 0, 0, [(world.address("fast.count"), 4)]))
        world.controller.run(cycles=1)
        assert reader.samples_of(1) == 1
        kept = reader
    with guest(file_of(world)) as reader:
        assert kept is not reader
        world.controller.run(cycles=1)
        assert reader.samples_of(1) == 0
        samples = reader.samples()
        reader.send(SampleCommand(2, 0, 0, [(world.address("fast.count"), 4)]))
        world.controller.run(cycles=2)
        assert len(samples.read()) == 2


def test_a_tidy_image_stays_as_it_is(world: World) -> None:
    tidy(ImageReader(world.fd), world.fd)
    world.controller.run(cycles=1)
    assert world.read("fast.count") == 1
