from plcsim.program.c.language import C_LANGUAGE


def test_a_folder_without_c_is_no_program_in_c(tmp_path):
    (tmp_path / "main.py").touch()
    (tmp_path / "folder.c").mkdir()
    assert C_LANGUAGE.units(tmp_path) == []
    (tmp_path / "Main.CPP").touch()
    (tmp_path / "part.c").touch()
    assert [file.name for file in C_LANGUAGE.units(tmp_path)] == ["Main.CPP", "part.c"]
