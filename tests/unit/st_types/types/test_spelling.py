from st_types.types.spelling import Spellings


def test_a_declared_name_is_itself_else_the_only_one_in_another_case() -> None:
    names = Spellings(["R_TRIG", "r_trig", "Speed"])
    assert names.of("r_trig") == "r_trig"
    assert names.of("SPEED") == "Speed"
    assert names.of("R_Trig") is None
    assert names.of("Torque") is None
    assert names.near("R_Trig") == ["R_TRIG", "r_trig"]
