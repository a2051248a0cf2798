"""cros_api.h: fields of all kinds, by cROS' names; programs in C hold the rest of it."""

import pytest

from crosnode.testing import Ros
from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError
from plcsim.project.assembly import load
from plcsim.project.plc_toml import read_project
from plcsim.testing import Plc

PLC = """
[task_class.1]
cycle = "1ms"
tolerance = "10ms"
programs = ["main"]
[ros]
packages = ["packages"]
"""
NUMBERS = """
float64[] values
int32 count
string[] names
hello inner
uint8[3] fixed
float32 ratio
bool flag
"""
MAIN = r"""
#include <bur/plctypes.h>
#include <AsDefault.h>
#include <cros_api.h>
static CrosNode *node;
DINT result[10];
static void echo(DynBuffer *buffer, cRosMessage *message)
{
	double v = 0;
	cRosMessageField *f = cRosMessageGetField(message, "values");
	result[0] += cRosMessageFieldArrayPushBackFloat64(f, 1.5);
	result[0] += cRosMessageFieldArrayPushBackFloat64(f, 2.5);
	cRosMessageFieldArrayAtFloat64(f, 1, &v);
	result[1] = (DINT)(10 * v);
	result[2] = f->size;
	cRosMessageGetField(message, "count")->data.as_int32 = -7;
	cRosMessageGetField(message, "ratio")->data.as_float32 = 0.5f;
	cRosMessageGetField(message, "flag")->data.as_uint8 = 1;
	f = cRosMessageGetField(message, "names");
	cRosMessageFieldArrayPushBackString(f, "one");
	f = cRosMessageGetField(message, "inner");
	result[3] = f->type;
	cRosMessageField *w = cRosMessageGetField(f->data.as_msg, "aWord");
	result[4] = w != NULL;
	cRosMessageSetFieldValueString(w, "deep");
	w = cRosMessageGetField(message, "inner.aWord");
	result[5] = w != NULL;
	f = cRosMessageGetField(message, "fixed");
	result[6] = f->size;
	result[7] = cRosMessageFieldArrayAtFloat64(f, 9, &v);
	result[8] = cRosMessageSerialize(message, buffer);
}
void _INIT ProgramInit(void)
{
	node = cRosNodeCreate("/nums", "127.0.0.1", "127.0.0.1", 11311, "/rosdb", NULL);
	cRosApiRegisterPublisher(node, "/numbers", "prova/numbers", 100);
}
void _CYCLIC ProgramCyclic(void)
{
	cRosNodeDoEventsLoop(node);
	while (node->pubs[1].queue_pubs != NULL)
		echo(pop(&(node->pubs[1].queue_pubs)), node->pubs[1].msg);
}
void _EXIT ProgramExit(void) { cRosNodeDestroy(node); }
"""
FILES = {
    "plc.toml": PLC,
    "packages/prova/package.xml": "<package><name>prova</name></package>",
    "packages/prova/msg/hello.msg": "string aWord\n",
    "packages/prova/msg/numbers.msg": NUMBERS,
    "main/Main.c": MAIN,
}
CROS_CUSTOM_TYPE = 0
ERR_FIELD = 50201


def test_numbers_arrays_texts_and_messages_in_a_message(tmp_path):
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    plc = Plc(load(read_project(tmp_path)))
    ros = Ros(plc)
    plc.boot()
    numbers = ros.subscribe("/numbers", "prova/numbers")
    plc.until(lambda: numbers.queue)
    message = numbers.pop()
    assert message is not None
    assert list(message.values) == [1.5, 2.5]
    assert (message.count, message.ratio, message.flag) == (-7, 0.5, True)
    assert (message.names, message.inner.aWord) == (["one"], "deep")
    assert list(plc["main.result"])[:9] == [0, 25, 2, CROS_CUSTOM_TYPE, 1, 1, 3, ERR_FIELD, 0]
    plc.close()
