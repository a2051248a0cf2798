import struct

import pytest

from plcsim.library.document import DocumentError
from plcsim.project.automation_studio.data_objects import encoded
from plcsim.project.automation_studio.reader import read_automation_studio

PROJECT = {
    "p.apj": "<Project/>",
    "Logical/Package.pkg": (
        '<Package><Objects><Object Type="Package">Data</Object></Objects></Package>'
    ),
    "Logical/Data/Package.pkg": (
        '<Package><Objects><Object Type="DataObject">Table</Object></Objects></Package>'
    ),
    "Logical/Data/Table/simple.DOB": (
        "<DataObject><Files><File>one.dat</File><File>two.dat</File></Files></DataObject>"
    ),
    "Logical/Data/Table/one.dat": ';speeds\r\n 12, -1 ; slow\r\n"A;b"\r\n',
    "Logical/Data/Table/two.dat": "$0000001F,2.5",
    "Physical/Physical.pkg": (
        '<Physical><Objects><Object Type="Configuration">C</Object></Objects></Physical>'
    ),
    "Physical/C/Cpu.sw": (
        "<Sw>\n<DataObjects>\n"
        '<DataObject Name="speeds" Source="data.Table.dob" Language="Simple"/>\n'
        '<DataObject Name="gone" Source="Data.Gone.dob" Language="Simple"/>\n'
        '<DataObject Name="Acp10sys" Source="" Language="Binary"/>\n'
        "</DataObjects></Sw>"
    ),
}
SPEEDS = struct.pack("<Ii", 12, -1) + b"A;b\0" + struct.pack("<If", 0x1F, 2.5)


def read(folder):
    found = read_automation_studio(folder)
    return found.data_objects.contents, [str(f) for f in found.findings if "data object" in str(f)]


def test_the_values_of_all_files_of_an_object(write):
    contents, (finding,) = read(write(PROJECT))
    assert contents == {"speeds": SPEEDS}
    assert finding.endswith(
        "Cpu.sw:4: warning: data object gone: the logical view has no Data.Gone"
    )


@pytest.mark.parametrize(
    ("files", "message"),
    [
        ({"Logical/Data/Table/two.dat": "1\n 12x"}, "two.dat: '12x' is no value"),
        ({"Logical/Data/Table/two.dat": '"open\n"'}, "two.dat: '\"open' is no value"),
        ({"Logical/Data/Table/simple.DOB": "<DataObject"}, ""),
        (
            {"Logical/Data/Table/simple.DOB": "<D><File>three.dat</File></D>"},
            "File three.dat is listed and not there",
        ),
    ],
)
def test_an_object_that_cannot_be_read_is_told_and_not_there(write, files, message):
    contents, findings = read(write({**PROJECT, **files}))
    assert contents == {}
    assert any("warning: data object speeds is not there: " + message in f for f in findings)


def test_a_list_that_is_not_there(write):
    files = {name: text for name, text in PROJECT.items() if not name.endswith("DOB")}
    contents, findings = read(write(files))
    assert contents == {}
    assert any("there is no Simple.dob" in each for each in findings)


@pytest.mark.parametrize(
    ("text", "data"),
    [
        (b"", b""),
        (b"\xef\xbb\xbf; nothing", b""),
        (b'"\xa7 = 1"', b"\xa7 = 1\0"),
        (b"00000251", struct.pack("<I", 251)),
        (b"-2147483648,4294967295", struct.pack("<iI", -(2**31), 2**32 - 1)),
        (b"1.,-1e3,$0", struct.pack("<ffI", 1.0, -1000.0, 0)),
    ],
)
def test_values(text, data):
    assert encoded(text) == data


def test_the_line_of_what_is_no_value():
    with pytest.raises(DocumentError) as caught:
        encoded(b"1,\n2,\n$G")
    assert (str(caught.value), caught.value.line) == ("'$G' is no value", 3)
