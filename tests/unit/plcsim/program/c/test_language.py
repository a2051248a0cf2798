from plcsim.program.c.language import C_LANGUAGE


def test_a_folder_without_c_is_no_program_in_c(tmp_path):
    assert C_LANGUAGE.units([tmp_path / "main.py", tmp_path / "main.h"]) == []
    files = [tmp_path / "Main.CPP", tmp_path / "part.c"]
    assert C_LANGUAGE.units([tmp_path / "main.var", *files]) == files
