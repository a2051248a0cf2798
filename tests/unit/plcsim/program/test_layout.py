"""Where the sources of a project of folders lie."""

from plcsim.program.layout import folder_layout, library_folders


def test_where_libraries_are_looked_for(project):
    deep = "a/b/c/d/"
    files = ["ramps/r.fun", "lib/more/R.FUN", "main/local.fun", "main/inner/i.fun", "tests/t.fun"]
    files += [".git/g.fun", "_old/o.fun", "ramps/inner/i.fun", f"{deep}d.fun", f"{deep}e/e.fun"]
    folder = project(dict.fromkeys(files, ""))
    found = library_folders(folder, [folder / "main"])
    assert [str(path.relative_to(folder)) for path in found] == ["a/b/c/d", "lib/more", "ramps"]


def test_a_folder_that_may_not_be_read_holds_no_library(project, monkeypatch):
    folder = project({"ramps/r.fun": "", "closed/c.fun": ""})
    real = __import__("os").access
    monkeypatch.setattr("os.access", lambda path, mode: "closed" not in path and real(path, mode))
    assert library_folders(folder) == [folder / "ramps"]
    assert library_folders(folder / "gone") == []


def test_a_program_lies_between_folders_that_declare_names(project):
    files = ["Global.var", "lines/Lines.typ", "lines/left/main.py", "lines/left/Local.var"]
    folder = project(dict.fromkeys(files, ""))
    layout = folder_layout(folder, ["lines/left"])
    place = layout.programs["lines/left"]
    around = (layout.common, *place.around)
    assert [(each.name, [file.name for file in each.files]) for each in around] == [
        (folder.name, ["Global.var"]),
        ("lines", ["Lines.typ"]),
    ]
    assert [file.name for file in place.own.files] == ["Local.var", "main.py"]


def test_a_library_outside_a_project_counts_once(project, tmp_path):
    folder = project({"ramps/r.fun": ""})
    outside = tmp_path / "outside"
    outside.mkdir()
    layout = folder_layout(folder, [], [outside, outside, folder / "ramps"])
    assert [place.package for place in layout.libraries] == ["ramps", "outside"]
    assert not any(place.is_vendor for place in layout.libraries)
