"""An Automation Studio project of one program, with libraries of mapp that come compiled."""

from textwrap import dedent

import pytest

from plcsim.testing.target import open_plc

HEAD = '<?xml version="1.0" encoding="utf-8"?>\n<?AutomationStudio FileVersion="4.9"?>\n'

MP_BASE = """
TYPE
    MpComIdentType : STRUCT
        Internal : ARRAY[0..1] OF UDINT;
    END_STRUCT;
END_TYPE
"""


def package(*objects):
    lines = (f'<Object Type="{kind}"{more}>{name}</Object>' for kind, name, more in objects)
    return f"{HEAD}<Package><Objects>{''.join(lines)}</Objects></Package>"


def library(*files):
    listed = "".join(f"<File>{each}</File>" for each in files)
    return f'{HEAD}<Library SubType="binary"><Files>{listed}</Files></Library>'


def task(code, variables):
    """The files of a program that runs in Cyclic#1, every 10 ms."""
    return {
        "Logical/Main/IEC.prg": f"{HEAD}<Program><Files><File>Main.st</File>"
        "<File>Main.var</File></Files></Program>",
        "Logical/Main/Main.st": dedent(code),
        "Logical/Main/Main.var": f"VAR\n{dedent(variables)}\nEND_VAR\n",
    }


def frame(libraries):
    """The files around the program: packages, one configuration, one task."""
    files = {
        "Filler.apj": f"{HEAD}<Project />",
        "Logical/Package.pkg": package(
            ("Package", "Libraries", ""),
            ("Program", "Main", ' Language="IEC"'),
            ("File", "Global.var", ""),
        ),
        "Logical/Libraries/Package.pkg": package(
            *(("Library", name, ' Language="Binary"') for name in libraries)
        ),
        "Physical/Physical.pkg": f'{HEAD}<Physical><Objects><Object Type="Configuration">PC'
        "</Object></Objects></Physical>",
        "Physical/PC/Config.pkg": f'{HEAD}<Configuration><Objects><Object Type="File">'
        'Hardware.hw</Object><Object Type="Cpu">CPU</Object></Objects></Configuration>',
        "Physical/PC/Hardware.hw": f'{HEAD}<Hardware><Module Name="PC" Type="PC_any">'
        '<Parameter ID="ConfigurationID" Value="PC" />'
        '<Parameter ID="Cyclic1Duration" Value="10000" />'
        '<Parameter ID="FileDeviceName1" Value="USER" />'
        '<Parameter ID="FileDevicePath1" Value="USER_PATH" />'
        "</Module></Hardware>",
        "Physical/PC/CPU/Cpu.pkg": f'{HEAD}<Cpu><Objects><Object Type="File">Cpu.sw</Object>'
        "</Objects></Cpu>",
        "Physical/PC/CPU/Cpu.sw": f'{HEAD}<SwConfiguration><TaskClass Name="Cyclic#1">'
        '<Task Name="Main" Source="Main.prg" Language="IEC" /></TaskClass></SwConfiguration>',
    }
    for name, texts in libraries.items():
        files[f"Logical/Libraries/{name}/Binary.lby"] = library(*texts)
        files |= {f"Logical/Libraries/{name}/{file}": text for file, text in texts.items()}
    return files


@pytest.fixture
def filler(tmp_path):
    """``filler(libraries, files, code, variables)``: the project, open on the virtual clock."""
    opened = []

    def make(libraries, files, code, variables, global_variables=""):
        libraries = {"MpBase": {"MpBase.typ": MP_BASE}, **libraries}
        texts = {
            "Logical/Global.var": f"VAR\n{dedent(global_variables)}\nEND_VAR\n",
            **frame(libraries),
            **task(code, variables),
            **files,
        }
        for name, text in texts.items():
            path = tmp_path / "filler" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")
        plc = open_plc(project=tmp_path / "filler")
        opened.append(plc)
        return plc.__enter__()

    yield make
    for plc in opened:
        plc.__exit__(None, None, None)
