"""The types of cROS that are shipped in crosnode: complete, laid out, and compiled by gcc -m32."""

import shutil
import subprocess
from pathlib import Path

import pytest

import st_types
from crosnode.node import StatusKind
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations
from st_types.syntax.printer import print_item
from st_types.syntax.source import Source
from st_types.types.derived import ArrayType, EnumerationType, StructType, resolve_alias
from st_types.types.elementary import ELEMENTARY, UDINT, DataType
from st_types.writers.c_header import Header, c_header
from st_types.writers.c_types import c_type_block
from st_types.writers.python_source import PythonModule, python_source

ROOT = Path(__file__).parents[4]
FILES = sorted(
    p for p in (ROOT / "crosnode" / "interface").iterdir() if p.suffix in (".typ", ".var", ".fun")
)
LIBRARY = sorted((ROOT / "plcsim" / "library" / "astcp").glob("*.[ftv]*"))

APPENDIX_D = """name host xmlrpc_port tcpros_port rpcros_port select_timeout pid roscore_pid
roscore_host roscore_port message_root_path log_level log_queue log_last_id next_call_id
master_api_queue slave_api_queue xmlrpc_client_proc xmlrpc_listner_proc xmlrpc_server_proc
tcpros_client_proc tcpros_listner_proc tcpros_server_proc rpcros_listner_proc rpcros_server_proc
pubs subs services paramsubs n_pubs n_subs n_services n_paramsubs"""

COUNTS = {
    "xmlrpc_client_proc": 6,
    "xmlrpc_server_proc": 5,
    "tcpros_client_proc": 6,
    "tcpros_server_proc": 5,
    "rpcros_server_proc": 8,
    "pubs": 5,
    "subs": 5,
    "services": 8,
    "paramsubs": 20,
}
"""Elements of the arrays in appendix D."""

STRUCTURES = """TcpipSocket DynBuffer DynString QueueArgExtFun QueueStatus CrosNodeStatusUsr
PublisherNode SubscriberNode ServiceProviderNode ParameterSubscription TcprosProcess XmlrpcProcess
XmlrpcParam XmlrpcParamVector RosApiCall ApiCallQueue CrosLog CrosLogQueue cRosMessage
cRosMessageField CrosNode"""


@pytest.fixture(scope="module")
def table() -> Scope:
    files = [parse_declarations(Source.read(path)) for path in FILES]
    library = [parse_declarations(Source.read(path)) for path in LIBRARY]
    made = Scope("cROS", files, [Scope("AsTCP", library)], strict=True)
    made.check()
    for file in files:
        assert file.diagnostics.records == []
    return made


def struct(table: Scope, name: str) -> StructType[object]:
    found = table.find_type(name)
    assert isinstance(found, StructType)
    return found


def test_the_node_has_the_members_of_appendix_d_in_order(table: Scope) -> None:
    node = struct(table, "CrosNode")
    assert [member.name for member in node.members] == APPENDIX_D.split()
    assert list(node.offsets) == sorted(node.offsets)
    for name, count in COUNTS.items():
        array = node.find(name)[0].data_type
        assert isinstance(array, ArrayType)
        assert (array.bounds, array.count) == (((0, count - 1),), count)


@pytest.mark.parametrize("name", STRUCTURES.split())
def test_every_structure_goes_down_to_elementary_types(table: Scope, name: str) -> None:
    def walk(declared: DataType[object], path: tuple[str, ...]) -> int:
        data_type = resolve_alias(declared)
        assert data_type.name not in path, "a STRUCT contains itself"
        if isinstance(data_type, ArrayType):
            return data_type.count * walk(data_type.element, path)
        if isinstance(data_type, StructType):
            inner = (*path, data_type.name)
            return sum(walk(member.data_type, inner) for member in data_type.members)
        return 1

    assert walk(struct(table, name), ()) >= 2


def test_a_message_is_a_handle_where_c_has_a_recursion(table: Scope) -> None:
    for owner in ("PublisherNode", "SubscriberNode"):
        handle = struct(table, owner).find("msg")[0].data_type
        assert handle.name == "cRosMessageHandle"
        assert resolve_alias(handle) is UDINT
    for queue in ("QueueArgExtFun", "QueueStatus"):
        assert struct(table, queue).find("next")[0].data_type is UDINT


def test_the_fundamental_types_are_those_of_the_table_in_st_types(table: Scope) -> None:
    text = (ROOT / "crosnode" / "interface" / "CTypes.typ").read_text()
    assert text.endswith("*)\n\n" + print_item(c_type_block()))
    select_timeout = struct(table, "CrosNode").find("select_timeout")[0].data_type
    assert resolve_alias(select_timeout) is ELEMENTARY["ULINT"]


def test_news_are_those_of_the_node(table: Scope) -> None:
    kinds = table.find_type("CrosNewsKind")
    assert isinstance(kinds, EnumerationType)
    assert dict(kinds.values) == {"CROS_NEWS_NONE": 0} | {
        f"CROS_NEWS_{kind.name}": kind.value for kind in StatusKind
    }


def test_functions_take_and_give_handles(table: Scope) -> None:
    """The names are those of cROS and of the thesis' figures 1.13 to 1.22, where it has them."""
    functions = {function.name: function for function in table.functions}
    for name in (
        "cRosNodeCreate",
        "cRosNodeDoEventsLoop",
        "cRosNodeDestroy",
        "cRosApiRegisterPublisher",
        "cRosApiRegisterSubscriber",
        "cRosApiRegisterServiceProvider",
        "cRosMessageGetField",
        "cRosMessageSetFieldValueString",
    ):
        assert name in functions
    for name in functions:
        assert len(name) <= 32  # as long as a name may be in Automation Studio 4
    for function in functions.values():
        first, *_ = function.variables
        is_handle = resolve_alias(first.data_type) is UDINT
        assert is_handle or (function.name, first.name) == ("cRosNodeCreate", "node_name")


def test_a_python_program_sees_the_node(table: Scope) -> None:
    module: dict[str, object] = {"__name__": "cros_types"}
    exec(compile(python_source(PythonModule("cros", table), "cROS"), "cros_types", "exec"), module)
    node = module["CrosNode"]()  # type: ignore[operator]  # mypy does not know what was executed
    assert node.log_level == 2
    node.pubs[4].topic_name = "/joint_states"
    node.xmlrpc_client_proc[0].socket.TcpOpen_1.port = 11311
    assert node.pubs[4].topic_name == "/joint_states"
    assert len(bytes(node)) == struct(table, "CrosNode").size


@pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not here")
def test_the_header_compiles_and_lies_as_laid_out(table: Scope, tmp_path: Path) -> None:
    header = Header(table)
    lines = [c_header(header, "CrosNode"), "#include <stddef.h>"]
    for data_type, name in header.names.items():
        lines.append(f'_Static_assert(sizeof({name}) == {data_type.size}, "{name}");')
        if isinstance(data_type, StructType):
            for member, offset in zip(data_type.members, data_type.offsets, strict=True):
                place = f"offsetof({name}, {member.name})"
                lines.append(f'_Static_assert({place} == {offset}, "{name}.{member.name}");')
    (tmp_path / "check.c").write_text("\n".join(lines) + "\n")
    include = Path(st_types.__file__).parent / "writers" / "include"
    command = ["gcc", "-m32", "-Wall", "-Werror", "-fsyntax-only", "-I", str(include), "check.c"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    if "sys/cdefs.h" in done.stderr:
        pytest.skip("gcc -m32 is not here (package gcc-multilib)")
    assert done.stderr == ""
