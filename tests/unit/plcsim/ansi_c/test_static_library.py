from pathlib import Path

from plcsim.ansi_c.static_library import UNIT_TEST, StaticLibrary


def test_a_library_is_used_where_a_file_of_its_folder_was_read(tmp_path):
    library = StaticLibrary((), (tmp_path / "lib",))
    assert library.is_used([str(tmp_path / "lib" / "include" / "a.h")])
    assert not library.is_used([str(tmp_path / "library" / "a.h")])


def test_links_lead_to_the_same_library(tmp_path):
    (tmp_path / "lib").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "lib")
    library = StaticLibrary((), (tmp_path / "lib",))
    assert library.is_used([str(tmp_path / "link" / "a.h")])


def test_a_header_is_known_by_its_name_wherever_it_lies():
    assert UNIT_TEST.is_used(["/somewhere/UnitTest.h"])
    assert not UNIT_TEST.is_used(["/somewhere/unit/test.h"])
    assert all(Path(file).is_file() for file in UNIT_TEST.sources)
