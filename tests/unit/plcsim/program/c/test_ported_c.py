"""C as it is written for Linux, in a unit: a port of it should be its sockets and its main."""

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State

PLC = """
[task_class.1]
cycle = "10ms"
programs = ["main"]
[library.FileIO.devices]
"F:" = "messages"
"""
SOURCE = r"""
#include <assert.h>
#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <float.h>
#include <inttypes.h>
#include <limits.h>
#include <locale.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/select.h>
#include <sys/time.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>
#include <bur/plctypes.h>

typedef struct DynString { char *data; int len, max; } DynString;
typedef enum { P_INT, P_STRING, P_DOUBLE, P_ARRAY } ParamType;
typedef struct Param {
	ParamType type;
	union { int32_t as_int; char *as_string; double as_double; struct Param *as_array; } data;
	int count, room;
} Param;
typedef struct Field { char *type, *name; int size; } Field;
typedef struct Definition { Field **fields; int count; char text[2048]; } Definition;
typedef int (*Handler)(const Param *, DynString *);

UDINT logged;
DINT result[8];
char answer[400];
LREAL seconds;

static void log_message(const char *level, const char *format, ...)
{
	va_list values;
	char text[256];
	va_start(values, format);
	vsnprintf(text, sizeof text, format, values);
	va_end(values);
	logged += (UDINT)printf("[%s] %s\n", level, text);
}

static int append(DynString *text, const char *format, ...)
{
	va_list values, again;
	va_start(values, format);
	va_copy(again, values);
	int more = vsnprintf(NULL, 0, format, again);
	va_end(again);
	if (text->len + more + 1 > text->max) {
		int max = text->max ? 2 * text->max : 16;
		while (max < text->len + more + 1)
			max *= 2;
		char *area = realloc(text->data, (size_t)max);
		if (!area)
			return -ENOMEM;
		text->data = area;
		text->max = max;
	}
	vsnprintf(text->data + text->len, (size_t)more + 1, format, values);
	va_end(values);
	text->len += more;
	return 0;
}

static void release(Param *param)
{
	if (param->type == P_STRING)
		free(param->data.as_string);
	for (int i = 0; param->type == P_ARRAY && i < param->count; i++)
		release(&param->data.as_array[i]);
	if (param->type == P_ARRAY)
		free(param->data.as_array);
}

static const char *parse(const char *at, Param *param);

static const char *parse_array(const char *at, Param *param)
{
	param->type = P_ARRAY;
	while (!strncmp(at, "<value>", 7)) {
		if (param->count == param->room) {
			param->room = param->room ? 2 * param->room : 2;
			param->data.as_array = realloc(param->data.as_array, param->room * sizeof(Param));
		}
		memset(&param->data.as_array[param->count], 0, sizeof(Param));
		at = parse(at, &param->data.as_array[param->count++]);
	}
	return strstr(at, "</array>") + strlen("</array>");
}

static const char *parse(const char *at, Param *param)
{
	at += strlen("<value>");
	if (!strncmp(at, "<array><data>", 13)) {
		at = parse_array(at + 13, param);
	} else if (sscanf(at, "<int>%" SCNd32 "</int>", &param->data.as_int) == 1) {
		param->type = P_INT;
	} else if (sscanf(at, "<double>%lf</double>", &param->data.as_double) == 1) {
		param->type = P_DOUBLE;
	} else {
		const char *begin = strchr(at, '>') + 1, *end = strchr(begin, '<');
		param->type = P_STRING;
		param->data.as_string = calloc(1, (size_t)(end - begin) + 1);
		memcpy(param->data.as_string, begin, (size_t)(end - begin));
	}
	return strstr(at, "</value>") + strlen("</value>");
}

static int count_all(const Param *param, DynString *out)
{
	int sum = 1;
	for (int i = 0; param->type == P_ARRAY && i < param->count; i++)
		sum += count_all(&param->data.as_array[i], out);
	return sum;
}

static int print_all(const Param *param, DynString *out)
{
	switch (param->type) {
	case P_INT:
		return append(out, "%d;", param->data.as_int);
	case P_DOUBLE:
		return append(out, "%.3f;", param->data.as_double);
	case P_STRING:
		return append(out, "'%s';", param->data.as_string);
	case P_ARRAY:
		append(out, "[");
		for (int i = 0; i < param->count; i++)
			print_all(&param->data.as_array[i], out);
		return append(out, "]");
	}
	return -1;
}

static const struct { const char *name; Handler handler; } handlers[] = {
	{"count", count_all}, {"print", print_all},
};

static char *read_file(const char *root, const char *type)
{
	char *path = malloc(strlen(root) + strlen(type) + 16);
	sprintf(path, "%s/%s.msg", root, type);
	FILE *file = fopen(path, "r");
	free(path);
	if (!file) {
		log_message("ERROR", "%s: %s", type, strerror(errno));
		return NULL;
	}
	fseek(file, 0, SEEK_END);
	long size = ftell(file);
	rewind(file);
	char *text = malloc((size_t)size + 1);
	text[fread(text, 1, (size_t)size, file)] = 0;
	fclose(file);
	return text;
}

static int by_name(const void *a, const void *b)
{
	return strcmp((*(Field *const *)a)->name, (*(Field *const *)b)->name);
}

static Definition *load(const char *root, const char *type)
{
	char *text = read_file(root, type), *rest, *inner;
	if (!text)
		return NULL;
	Definition *found = calloc(1, sizeof *found);
	for (char *line = strtok_r(text, "\r\n", &rest); line; line = strtok_r(NULL, "\r\n", &rest)) {
		char *comment = strchr(line, '#');
		if (comment)
			*comment = 0;
		char *kind = strtok_r(line, " \t", &inner), *name = strtok_r(NULL, " \t", &inner);
		if (!kind || !name)
			continue;
		Field *field = malloc(sizeof *field);
		*field = (Field){strdup(kind), strdup(name), -1};
		char *bracket = strchr(field->type, '[');
		if (bracket && isdigit((unsigned char)bracket[1]))
			field->size = (int)strtol(bracket + 1, NULL, 10);
		found->fields = realloc(found->fields, (found->count + 1) * sizeof *found->fields);
		found->fields[found->count++] = field;
	}
	qsort(found->fields, (size_t)found->count, sizeof *found->fields, by_name);
	free(text);
	return found;
}

static void forget(Definition *found)
{
	for (int i = 0; i < found->count; i++) {
		free(found->fields[i]->type);
		free(found->fields[i]->name);
		free(found->fields[i]);
	}
	free(found->fields);
	free(found);
}

void _INIT start(void)
{
	setlocale(LC_NUMERIC, "");
	signal(SIGPIPE, SIG_IGN);
	srand((unsigned)time(NULL) ^ (unsigned)getpid());
	log_message("INFO", "root %s, home %s", "F:", getenv("HOME") ? "there" : "not there");
}

void _CYCLIC run(void)
{
	Param all = {0};
	DynString out = {0};
	struct timeval now;
	fd_set set;
	Field wanted = {NULL, "x", 0}, *key = &wanted;

	parse("<value><array><data><value><int>-7</int></value><value><string>a b</string></value>"
		"<value><array><data><value><double>2.5</double></value></data></array></value>"
		"</data></array></value>", &all);
	for (size_t i = 0; i < sizeof handlers / sizeof *handlers; i++)
		result[i] = handlers[i].handler(&all, &out);
	append(&out, "%08.3f|%-6s|%+d|%#x|%5.1e|%lld|%zu|%c|%%", M_PI, "ab", 5, 255, 12345.678,
		LLONG_MIN, sizeof(int), 'z');
	strncpy(answer, out.data, sizeof answer - 1);
	free(out.data);
	release(&all);

	Definition *found = load("F:", "geometry/Point");
	result[2] = found->count;
	size_t size = sizeof *found->fields;
	Field **hit = bsearch(&key, found->fields, (size_t)found->count, size, by_name);
	result[3] = hit && !strcmp((*hit)->type, "float64");
	result[4] = found->fields[0]->size;
	forget(found);
	result[5] = load("F:", "geometry/Nothing") == NULL && errno == ENOENT;
	gettimeofday(&now, NULL);
	seconds = (double)now.tv_sec + now.tv_usec / 1e6;
	FD_ZERO(&set);
	FD_SET(33, &set);
	result[6] = FD_ISSET(33, &set) && !FD_ISSET(1, &set);
}
"""
POINT = "# a point\nfloat64 x\nfloat64 y # second\n\nint32[3] numbers\n"
FILES = {"plc.toml": PLC, "main/main.c": SOURCE, "messages/geometry/Point.msg": POINT}


@pytest.fixture(autouse=True)
def _a_compiler():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


def test_it_runs_as_it_does_on_linux_and_forgets_no_memory(run, value, capfd):
    controller = run(FILES, cycles=500)
    assert controller.state is State.RUN, controller.fault
    assert value(controller, "main.answer") == (
        "[-7;'a b';[2.500;]]0003.142|ab    |+5|0xff|1.2e+04|-9223372036854775808|4|z|%"
    )
    assert list(value(controller, "main.result"))[:7] == [5, 0, 3, 1, 3, 1, 1]
    printed = capfd.readouterr().out
    assert printed.startswith("[INFO] root F:, home not there\n")
    assert printed.count("[ERROR] geometry/Nothing: no such file or folder\n") == 500
    assert value(controller, "main.seconds") == pytest.approx(946684800 + 4.99, abs=0.02)
