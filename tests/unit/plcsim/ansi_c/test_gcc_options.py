import pytest

from plcsim.ansi_c.gcc_options import for_language, of_layout, of_version, split


@pytest.mark.parametrize(
    ("line", "of_c", "of_cpp"),
    [
        ('-D A -DB="x y" -I inc', ["-D", "A", "-DB=x y", "-I", "inc"], None),
        ("-msse2 -mfpmath=sse -O0 -g3 -fcommon -DX", ["-DX"], None),
        ("-Werror -Werror=format -Wall -fshort-enums", ["-Wall", "-fshort-enums"], None),
        ("-std=c99 -DX", ["-std=c99", "-DX"], ["-DX"]),
        ("-std=gnu++11 -DX", ["-DX"], ["-std=gnu++11", "-DX"]),
        ("-w -Wno-return-type -Wno-unused", ["-Wno-unused"], None),
        ("-fgnu89-inline", ["-fgnu89-inline"], []),
        ("-fstack-protector-all -fprofile-arcs --coverage -flto", [], None),
        ('-DX="', ['-DX="'], None),
    ],
)
def test_what_clang_has_of_the_options_of_a_project(line, of_c, of_cpp):
    options = split(line)
    assert for_language(options, is_c=True) == of_c
    assert for_language(options, is_c=False) == (of_c if of_cpp is None else of_cpp)


def test_sources_find_the_version_that_they_were_written_for():
    assert of_version("") == []
    assert of_version("6.3.0") == [
        *("-U__GNUC__", "-D__GNUC__=6", "-U__GNUC_MINOR__", "-D__GNUC_MINOR__=3"),
        *("-U__GNUC_PATCHLEVEL__", "-D__GNUC_PATCHLEVEL__=0"),
    ]
    assert of_version("4.1.2")[-1] == "-fgnu89-inline"


def test_sources_of_others_share_what_concerns_the_layout_of_data():
    assert of_layout(["-std=gnu++98", "-DX", "-fshort-enums"]) == ["-fshort-enums"]


def test_what_a_source_throws_it_tells_itself():
    assert split("-fno-exceptions -frtti -fshort-enums") == ["-fshort-enums"]


def test_debug_information_is_not_switched_off_by_a_project():
    assert split("-g0 -g3 -DX=1") == ["-DX=1"]
