"""Times of the I/O cycle."""


def test_the_start_of_the_cycle_in_microseconds_wraps(plc):
    plc.context.release_ns = 5_000_999
    assert plc.function("AsIOTimeCyclicStart")() == 5000
    plc.context.release_ns = 2**31 * 1000
    assert plc.function("AsIOTimeCyclicStart")() == -(2**31)


def test_the_stamp_goes_on_within_a_cycle(plc):
    plc.pass_ms(1)
    plc.clock.sleep_until_ns(1_250_000)
    assert plc.function("AsIOTimeCyclicStart")() == 1000
    assert plc.function("AsIOTimeStamp")() == 1250
