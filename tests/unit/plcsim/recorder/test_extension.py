import re
from pathlib import Path

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.controller import Controller
from plcsim.core.errors import TagError
from plcsim.core.logbook import Severity
from plcsim.network import VirtualNetwork
from plcsim.project.assembly import assemble
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.extension import EXTENSION, sources_of
from plcsim.recorder.settings import RecordProject, RecordSettings

from .conftest import Fast, Recordings, application_of

SERVICE = "plcsim.recorder.service.process"


def project(folder: Path, *tags: str) -> RecordProject:
    return RecordProject(RecordSettings(file="a.bag", tags=tags), folder)


def test_a_process_of_its_own_records_on_the_real_clock_only(tmp_path: Path) -> None:
    made = project(tmp_path)

    assert EXTENSION.service(made) == SERVICE
    assert EXTENSION.service(EXTENSION.in_process(made, "192.168.0.10")) == ""
    assert EXTENSION.service(EXTENSION.in_test(made, "192.168.0.10")) == ""


def test_a_test_leaves_no_bag(tmp_path: Path) -> None:
    settings = EXTENSION.in_test(project(tmp_path), "192.168.0.10")
    application = application_of(Fast, extensions={"record": settings})
    clock = VirtualClock()
    net = VirtualNetwork(clock.now_ns).host("192.168.0.10")

    controller = assemble(application, clock=clock, network=net)
    controller.boot()
    controller.run(cycles=3)

    assert controller.clock is clock
    assert list(tmp_path.iterdir()) == []


def test_check_finds_tags_that_are_not_there(tmp_path: Path) -> None:
    clock = VirtualClock()
    net = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    controller = assemble(application_of(Fast), clock=clock, network=net)

    assert EXTENSION.check(project(tmp_path, "Fast.count"), controller) == ()
    with pytest.raises(TagError, match="did you mean"):
        EXTENSION.check(project(tmp_path, "Fast.cuont"), controller)


def test_the_head_names_the_sources_of_the_project(recordings: Recordings) -> None:
    folder = recordings.folder
    (folder / "prog").mkdir()
    (folder / "prog" / "main.py").write_text("pass\n")
    (folder / "tests").mkdir()
    (folder / "tests" / "test_x.py").write_text("pass\n")

    with open_bag(recordings("a.bag", application_of(Fast))) as bag:
        sources = bag.head().sources
    assert list(sources) == ["prog/main.py"]
    assert sources == sources_of(folder)
    (folder / "prog" / "main.py").write_text("pass  # other\n")
    assert sources != sources_of(folder)


def test_a_full_disk_ends_the_recording_and_not_the_controller(
    recordings: Recordings, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    seen: list[Controller] = []

    def break_down(controller: Controller) -> None:
        monkeypatch.setattr("plcsim.recorder.bag.files.Ros1Bag.write", full)
        seen.append(controller)

    recordings("a.bag", application_of(Fast), act=break_down)

    (controller,) = seen
    assert controller.classes[0].cycles == 40
    errors = [entry.text for entry in controller.logbook if entry.severity is Severity.ERROR]
    told = capsys.readouterr().err.removeprefix("record: ").rstrip()  # with --quiet as well
    assert errors == [f"the recording ends: {told}"]
    assert re.search(r"a\.bag: cannot be written: \[Errno 28\] No space left on device", told)
    left = re.search(r"; plcsim bag reindex (\S+) makes readable what is there", told)
    assert left
    assert Path(left[1]).is_file()
