"""Plants, stimuli, forces, faults and peers around the programs."""

from pathlib import Path

import pytest

from plcsim import Program, adr, sizeof
from plcsim.core.errors import TagError
from plcsim.library.astcp import TcpOpen, TcpRecv, TcpSend, TcpServer
from plcsim.testing import PlantError, PlcTestError, StimulusError, open_plc
from st_types import ARRAY, UDINT, UINT, USINT, var

MS = 1_000_000


# --- plants ---


def test_a_plant_is_stepped_with_the_scan(cell_plc):
    steps = []

    @cell_plc.plant
    def tank(tags, elapsed_ns):
        steps.append((tags["Cell.count"], elapsed_ns))
        return {"Cell.level": tags["Cell.level"] + elapsed_ns / 1e9}

    cell_plc.run("30ms")
    assert steps == [(0, 5 * MS), (1, 10 * MS), (2, 10 * MS)]
    assert cell_plc["Cell.level"] == pytest.approx(0.025)


def test_an_object_with_a_step_is_a_plant_and_writes_by_itself(cell_plc):
    class Door:
        def step(self, tags, elapsed_ns):
            tags["Cell.start"] = True

    cell_plc.plant(Door())
    cell_plc.cycles()
    assert cell_plc["Cell.motor.on"]


@pytest.mark.parametrize("model", [None, 3, dict])
def test_what_is_no_plant_is_refused(cell_plc, model):
    with pytest.raises(PlcTestError, match="is no plant"):
        cell_plc.plant(model)


def test_a_plant_that_raises_is_named_with_cycle_and_place(cell_plc):
    @cell_plc.plant
    def broken(tags, elapsed_ns):
        return {"Cell.none": 1}

    with pytest.raises(PlantError, match="plant broken raised in cycle 1 at 5 ms: no tag"):
        cell_plc.run("1s")


def test_time_of_a_plant_starts_at_0_after_a_restart(cell_plc):
    steps = []
    cell_plc.plant(lambda tags, elapsed_ns: steps.append(elapsed_ns))
    cell_plc.cycles(2)
    cell_plc.restart()
    cell_plc.cycles(2)
    assert steps == [5 * MS, 10 * MS, 5 * MS, 10 * MS]


# --- stimuli ---


def write(path: Path, text):
    path.write_text(text)
    return path


def test_stimuli_from_a_file(cell_plc, tmp_path):
    file = write(
        tmp_path / "s.csv",
        "time, Cell.start, Cell.light, Cell.delay\n0ms,FALSE,RED,\n20ms,TRUE,,1s\n",
    )
    assert cell_plc.stimulate(file) == 20 * MS
    cell_plc.run("20ms")
    assert (cell_plc["Cell.start"], cell_plc["Cell.delay"]) == (False, 20)
    cell_plc.run("10ms")
    assert (cell_plc["Cell.start"], cell_plc["Cell.delay"]) == (True, 1000)


def test_times_as_numbers(cell_plc, tmp_path):
    cell_plc.stimulate(write(tmp_path / "s.csv", "time_s,Cell.start\n0.0145,1\n"))
    cell_plc.until("Cell.start", within="15ms")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is empty"),
        ("when,Cell.start\n", "s.csv:1: the first column is 'when'"),
        ("time,Cell.strat\n", "s.csv:1: no tag 'Cell.strat'.*did you mean Cell.start"),
        ("time,Cell.start\nsoon,1\n", "s.csv:2: time: 'soon' is not a duration"),
        ("time_ms,Cell.start\nx,1\n", "s.csv:2: time_ms: 'x' is not a number"),
        ("time_ns,Cell.start\n0.5,1\n", "s.csv:2: time_ns: '0.5' is not a whole number"),
        ("time,Cell.start\n1ms,maybe\n", "s.csv:2: Cell.start: 'maybe' is not TRUE or FALSE"),
        ("time,Cell.initial\n1ms,70000\n", "s.csv:2: Cell.initial: .*70000 is outside"),
        ("time,Cell.start\n1ms\n", "s.csv:2: 1 cells under 2 column names"),
        ("time,Cell.start\n2ms,1\n1ms,0\n", "s.csv:3: time: is before the line above"),
    ],
)
def test_wrong_files_name_line_and_column(cell_plc, tmp_path, text, message):
    with pytest.raises(StimulusError, match=message):
        cell_plc.stimulate(write(tmp_path / "s.csv", text))


def test_listed_stimuli_are_checked_before_they_are_played(cell_plc):
    with pytest.raises(StimulusError, match=r"stimulus 2: .*3 is not a BOOL"):
        cell_plc.stimulate([("0ms", {"Cell.start": 1}), ("1ms", {"Cell.start": 3})])
    cell_plc.run("100ms")
    assert not cell_plc["Cell.start"]


# --- forces and faults of tags ---


def test_a_forced_tag_keeps_its_value_inside_and_outside(cell_plc):
    cell_plc.force("Cell.count", 100)
    cell_plc.cycles(3)
    assert cell_plc["Cell.count"] == 100
    cell_plc.release("cell.count")
    cell_plc.cycles(3)
    assert cell_plc["Cell.count"] == 103


def test_release_of_what_is_not_forced(cell_plc):
    cell_plc.force("Cell.start", True)
    with pytest.raises(PlcTestError, match=r"Cell.count is not forced; Cell.start is"):
        cell_plc.release("Cell.count")
    with pytest.raises(TagError, match="did you mean"):
        cell_plc.release("Cell.counts")


def test_a_stuck_tag_sticks_for_its_time(cell_plc):
    cell_plc.plant(lambda tags, ns: {"Cell.level": tags["Cell.count"] * 1.0})
    cell_plc.faults.stuck("Cell.level", at_cycle=4, for_="30ms")
    trace = cell_plc.record("Cell.level")
    cell_plc.run("100ms")
    assert trace.values("Cell.level") == [0, 1, 2, 6, 7, 8, 9]


def test_noise_stays_around_the_value_and_repeats_with_the_seed(new_plc):
    def levels(seed):
        plc = new_plc(10, seed=seed)
        plc["Cell.level"] = 50.0
        plc.faults.noise("Cell.level", 2.0)
        trace = plc.record("Cell.level")
        plc.run("2s")
        return trace.values("Cell.level")

    first = levels(1)
    assert len(set(first)) > 100
    assert all(48 <= level <= 52 for level in first)
    assert first == levels(1) != levels(2)


def test_noise_on_integers_stays_in_their_range(cell_plc):
    cell_plc.faults.noise("Cell.initial", 100)
    trace = cell_plc.record("Cell.initial")
    cell_plc.run("1s")
    assert min(trace.values("Cell.initial")) == 0


@pytest.mark.parametrize(("path", "amplitude"), [("Cell.start", 1), ("Cell.level", 0)])
def test_noise_needs_a_number_and_an_amplitude(cell_plc, path, amplitude):
    with pytest.raises(PlcTestError, match="noise"):
        cell_plc.faults.noise(path, amplitude)


def test_a_fault_begins_at_a_time_or_a_cycle_not_both(cell_plc):
    with pytest.raises(PlcTestError, match="either at or at_cycle"):
        cell_plc.faults.stuck("Cell.level", at="1ms", at_cycle=1)


# --- network ---


class Echo(Program):
    """Sends back what comes, one client."""

    open = var(TcpOpen)
    server = var(TcpServer)
    recv = var(TcpRecv)
    send = var(TcpSend)
    data = var(ARRAY(USINT, (0, 99)))
    pending = var(UDINT)
    status = var(UINT)

    def cyclic(self):
        if not self.open.ident:
            self.open(enable=True, port=5000)
            return
        if not self.server.identclnt:
            self.server(enable=True, ident=self.open.ident)
            return
        if not self.pending:
            self.recv(
                enable=True,
                ident=self.server.identclnt,
                pData=adr(self.data),
                datamax=sizeof(self.data),
            )
            self.status = self.recv.status
            self.pending = self.recv.recvlen if self.recv.status == 0 else 0
        if self.pending:
            self.send(
                enable=True,
                ident=self.server.identclnt,
                pData=adr(self.data),
                datalen=self.pending,
            )
            self.pending = 0 if self.send.status == 0 else self.pending


@pytest.fixture
def echo():
    with open_plc(program=Echo) as plc:
        yield plc


def test_a_peer_connects_sends_and_receives(echo):
    peer = echo.connect(5000)
    echo.until(lambda: peer.connected or peer.closed)
    if peer.closed:  # the listener was not there in the first cycle
        peer = echo.connect(5000)
    peer.send(b"hello")
    echo.until(lambda: peer.received == b"hello", within="1s")


def connected(echo):
    echo.cycles(5)
    peer = echo.connect(5000)
    echo.until(lambda: peer.connected, within="1s")
    return peer


def test_latency_takes_its_time(echo):
    peer = connected(echo)
    peer.send(b"a")
    quick_ns = echo.until(lambda: bool(peer.received), within="1s")
    echo.faults.latency("100ms")
    peer.send(b"b")
    assert echo.until(lambda: len(peer.received) == 2, within="1s") >= quick_ns + 190 * MS


def test_a_reset_ends_the_connection_at_both_ends(echo):
    peer = connected(echo)
    echo.faults.reset(at="50ms")
    echo.until(lambda: peer.closed == "reset", within="100ms")


def test_a_lost_peer_is_silent_from_its_cycle_on(echo):
    peer = connected(echo)
    echo.faults.lose_peer("192.168.0.20", at_cycle=echo.cycle_count + 10)
    echo.cycles(10)
    peer.send(b"x")
    echo.run("1s")
    assert peer.received == b""


def test_a_refused_port(echo):
    echo.cycles(5)
    echo.faults.refuse(echo.ip, 5000)
    peer = echo.connect(5000)
    echo.until(lambda: peer.closed == "refused", within="1s")


def test_an_address_that_is_none_is_refused(echo):
    with pytest.raises(PlcTestError, match="is not an address such as"):
        echo.faults.silence("pump")
