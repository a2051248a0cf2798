import pytest

from plcsim.ansi_c.prebuilt import declaring_header, has_objects

HEADER = """
#ifndef DRIVE_H
#define DRIVE_H
/* void drive_gone(void); */
#ifdef __cplusplus
extern "C" {
#endif
void drive_start(void);
unsigned long
drive_read(char *text, int (*each)(int, int));
extern const char * drive_name (int axis) __attribute__((pure));
static inline int drive_twice(int x) { drive_called(x); return drive_given(x); }
#define drive_macro(x) (x)
typedef int drive_type(void);
#ifdef __cplusplus
}
#endif
#endif
"""


@pytest.fixture
def drive(tmp_path):
    """The folder of a library: a header, and an object of the controller's processor."""
    (tmp_path / "drive.h").write_text(HEADER)
    objects = tmp_path / "SG4" / "IA32"
    objects.mkdir(parents=True)
    (objects / "drive.c.O").write_bytes(b"\x7fELF")
    return tmp_path


@pytest.mark.parametrize("name", ["drive_start", "drive_read", "drive_name"])
def test_what_a_header_declares(drive, name):
    assert declaring_header(drive, name) == drive / "drive.h"


@pytest.mark.parametrize(
    "name",
    [
        *("drive", "drive_gone", "drive_twice", "drive_called", "drive_given", "drive_macro"),
        *("drive_type", "each", "rive_start"),
    ],
)
def test_what_a_header_only_names(drive, name):
    assert declaring_header(drive, name) is None


def test_headers_without_compiled_code_beside_them_say_nothing(drive):
    (drive / "SG4" / "IA32" / "drive.c.O").rename(drive / "drive.txt")
    assert not has_objects(drive)
    assert declaring_header(drive, "drive_start") is None
    assert not has_objects(drive / "nowhere")
