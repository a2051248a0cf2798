from plcsim.project.automation_studio.names import FileNames, names_in


def test_names_are_found_in_any_case_with_either_separator(write):
    folder = write({"Logical/Line/Main.st": ""})
    names = FileNames(folder)
    file = folder / "Logical" / "Line" / "Main.st"
    for name in ("logical\\LINE\\main.ST", "\\Logical\\\\Line\\Main.st", "Logical/./line/main.st"):
        assert names.below(folder, name) == file
    assert names.below(folder / "Logical", "..\\logical\\line\\Main.st") == file
    assert names.below(folder, "Logical\\gone.st") is None


def test_a_reference_counts_from_the_project_then_from_its_list(write):
    folder = write({"Logical/a.h": "", "Logical/Line/b.h": ""})
    names = FileNames(folder)
    line = folder / "Logical" / "Line"
    assert names.referenced(line, "\\Logical\\A.H") == folder / "Logical" / "a.h"
    assert names.referenced(line, "b.h") == line / "b.h"
    assert names.referenced(line, "\\b.h") is None


def test_what_cannot_be_read_holds_nothing(tmp_path):
    assert names_in(tmp_path / "gone") == {}
