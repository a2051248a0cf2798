from st_types.resolve.name_index import NameIndex, SourceFile, nearest, report_duplicates
from st_types.syntax.declarations import parse_text


def index_of(**texts: str) -> NameIndex:
    return NameIndex([parse_text(text, path.replace("__", "/")) for path, text in texts.items()])


def user_in(path: str) -> SourceFile:
    return SourceFile(parse_text("", path))


def test_what_is_indexed() -> None:
    index = index_of(
        a="TYPE T : INT; E : (red, green); END_TYPE VAR CONSTANT MAX : INT; END_VAR "
        "VAR x : INT; END_VAR FUNCTION_BLOCK F END_FUNCTION_BLOCK FUNCTION G : INT END_FUNCTION"
    )
    assert sorted(index.types) == ["E", "F", "T"]
    assert sorted(index.enumeration_values) == ["GREEN", "RED"]
    assert sorted(index.constants) == ["MAX"]
    assert sorted(index.functions) == ["G"]
    assert index.constants["MAX"][0].is_constant
    assert [entry.node.name for entry in index.all_types()] == ["T", "E", "F"]


def test_the_nearest_declaration_is_meant() -> None:
    text = "TYPE T : INT; END_TYPE"
    index = index_of(
        Global_typ=text, P__A__T_typ=text, P__B__T_typ=text, P__T_typ=text, Lib__L__T_typ=text
    )
    candidates = index.types["T"]

    def found_from(path: str) -> str:
        return nearest(candidates, user_in(path)).owner.file.path

    assert found_from("P/A/x.var") == "P/A/T_typ"
    assert found_from("P/B/deep/x.var") == "P/B/T_typ"
    assert found_from("P/C/x.var") == "P/T_typ"
    assert found_from("Q/x.var") == "Global_typ"
    own = candidates[2].owner
    assert nearest(candidates, own) is candidates[2]


def test_declared_twice_in_a_file_is_an_error_and_in_a_folder_a_warning() -> None:
    text = "TYPE T : INT; END_TYPE"
    index = index_of(P__a=text + "\ntype t : BOOL; end_type", P__b=text, Q__c=text)
    report_duplicates(index, "types")
    found = [str(d) for owner in index.files for d in owner.file.diagnostics.records]
    assert found == [
        "P/a:2:6: error: t is declared twice; first at P/a:1:6",
        "P/b:1:6: warning: T is declared twice; first at P/a:1:6",
    ]
