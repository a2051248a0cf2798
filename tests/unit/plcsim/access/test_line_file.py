import json

from plcsim.access import LineFile


def test_a_full_file_is_renamed_and_the_oldest_goes(tmp_path):
    file = tmp_path / "new" / "audit.jsonl"
    lines = LineFile(file, 30, 3, "web")
    for number in range(8):
        lines.write({"number": number})
    lines.close()
    found = [
        [json.loads(line)["number"] for line in each.read_text().splitlines()]
        for each in (file, file.with_name("audit.jsonl.1"), file.with_name("audit.jsonl.2"))
    ]
    assert found == [[6, 7], [4, 5], [2, 3]]


def test_what_cannot_be_written_is_counted_and_told_once(tmp_path, capsys):
    folder = tmp_path / "gone"
    folder.write_text("a file where a folder should be")
    lines = LineFile(folder / "audit.jsonl", 1000, 3, "web")
    lines.write({"number": 1})
    lines.write({"number": 2})
    told = capsys.readouterr().err
    assert told.count("web: the audit log cannot be written") == 1
    folder.unlink()
    lines.write({"number": 3})
    lines.close()
    assert json.loads((folder / "audit.jsonl").read_text()) == {"number": 3, "lost": 2}
