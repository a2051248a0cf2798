"""The statuses of library runtime have the values that B&R's runtime.var gives them."""

from plcsim.library import astcp, runtime


def test_the_statuses_have_the_controllers_values():
    statuses = {name: value for name, value in vars(runtime).items() if name.startswith("ERR_")}
    assert statuses == {
        "ERR_OK": 0,
        "ERR_NOTIMPLEMENTED": 9999,
        "ERR_FUB_ENABLE_FALSE": 0xFFFE,
        "ERR_FUB_BUSY": 0xFFFF,
    }


def test_astcp_gives_them_on():
    names = [name for name in vars(runtime) if name.startswith("ERR_")]
    assert [getattr(astcp, name) for name in names] == [getattr(runtime, name) for name in names]
