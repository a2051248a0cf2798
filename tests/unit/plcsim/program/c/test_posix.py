"""C with what a port of a node for Linux takes for granted of POSIX, by each compiler.

Its sockets and its waiting are to be written anew; all else compiles, and does what it says within
the sandbox or gives its error number.
"""

import pytest

from plcsim.ansi_c.toolchain import system_clang, zig
from plcsim.core.system import State
from plcsim.project.assembly import load
from plcsim.project.plc_toml import read_project

PLC = """
[task_class.1]
cycle = "10ms"
programs = ["main"]
[library.FileIO.devices]
"F:" = "messages"
"""
HEADERS = """
stdnoreturn pthread sched getopt byteswap features sys/cdefs sys/errno sys/fcntl sys/ioctl
sys/poll sys/signal assert ctype errno fcntl float inttypes limits locale math setjmp signal
stdarg stdbool stddef stdint stdio stdlib string time wchar dirent libgen poll strings unistd
malloc alloca endian netdb sys/param sys/select sys/socket sys/stat sys/time sys/types
netinet/in netinet/tcp arpa/inet
"""
NODE = r"""
#include <bur/plctypes.h>

#define FN_BUFFER 256
#define CHECK(true) do { checks++; if (!(true)) wrong[failed++ % 8] = __LINE__; } while (0)

DINT wrong[8];
DINT failed, checks, exited;
char printed[300];

typedef struct DynBuffer { unsigned char *data; size_t size, max, pos_offset; } DynBuffer;
typedef uint32_t cRosErrCodePack;
typedef enum CrosLogLevel { DEBUG = 1, INFO = 2, WARN = 4 } CrosLogLevel;

static FILE *out_stream;
static int last_handler;

static void log_text(CrosLogLevel level, const char *file, int line, const char *format, ...)
{
	char text[FN_BUFFER], *copy = NULL;
	struct timespec now;
	va_list args, again;
	va_start(args, format);
	va_copy(again, args);
	clock_gettime(CLOCK_REALTIME, &now);
	int size = snprintf(text, sizeof text, "[%-5s %s:%d] %" PRIu32 ".%09ld: ",
		level == INFO ? "INFO" : "WARN", basename((char *)file), line > 0,
		(uint32_t)now.tv_sec, (long)now.tv_nsec);
	vsnprintf(text + size, sizeof text - (size_t)size, format, args);
	va_end(args);
	CHECK(vasprintf(&copy, format, again) == (int)strlen(text + size));
	va_end(again);
	CHECK(copy && !strcmp(copy, text + size));
	free(copy);
	fprintf(out_stream, "%s\n", text);
	strncpy(printed, text + size, sizeof printed - 1);
}

#define LOG(level, ...) log_text(level, __FILE__, __LINE__, __VA_ARGS__)

static int push(DynBuffer *buffer, const void *data, size_t count)
{
	if (buffer->size + count > buffer->max) {
		size_t max = buffer->max ? buffer->max : 8;
		while (max < buffer->size + count)
			max <<= 1;
		unsigned char *grown = (unsigned char *)realloc(buffer->data, max);
		if (!grown)
			return -1;
		buffer->data = grown;
		buffer->max = max;
	}
	memcpy(buffer->data + buffer->size, data, count);
	buffer->size += count;
	return (int)buffer->size;
}

static void handler(int number) { last_handler = number; }
static void leave(void) { exited++; }
static int by_text(const void *a, const void *b) { return strcmp(*(char **)a, *(char **)b); }

static void formats(void)
{
	char text[200];
	int count = -1, a, b;
	double d;
	char word[20], c;
	sprintf(text, "%lu|%zu|%5.2f|%g|%*d|%-*s|%.*s|%hhx|%#o|%+.3e|%c|%5%|%lld|%ju|%td|%i%n", 7ul,
		sizeof text, 3.14159, 1e-9, 6, -42, 5, "ab", 2, "xyz", 0x1ff, 8, 12345.678, '!',
		(long long)INT64_MIN, (uintmax_t)UINT64_MAX, (ptrdiff_t)-3, 5, &count);
	CHECK(!strncmp(text, "7|200| 3.14|1e-09|   -42|ab   |xy|ff|010|+1.235e+04|!|", 54));
	CHECK(count == (int)strlen(text));
	CHECK(strstr(text, "-9223372036854775808|18446744073709551615|-3|5"));
	CHECK(snprintf(text, 4, "%s", "abcdef") == 6 && !strcmp(text, "abc"));
	sprintf(text, "%p", (void *)printed);
	CHECK(!strncmp(text, "0x", 2) && strtoul(text, NULL, 16) == (uintptr_t)printed);
	CHECK(sscanf("http://127.0.0.1:11311/ 0x1F 2.5e3 ab]", "http://%19[^:]:%d/ %x %lf %2c", word,
		&a, (unsigned *)&b, &d, text) == 5 && a == 11311 && b == 31 && d == 2500 && *text == 'a');
	CHECK(sscanf("12 rest", "%*d %s%c", word, &c) == 1 && !strcmp(word, "rest"));
	CHECK(isnan(NAN) && isinf(HUGE_VAL) && lround(floor(-2.5)) == -3 && fabs(sin(M_PI)) < 1e-15);
	CHECK(strtoimax("-77", NULL, 10) == -77 && imaxabs(-5) == 5 && atof("1e-3") == 0.001);
	CHECK(INT_MAX == 2147483647 && PATH_MAX > 100 && DBL_DIG == 15 && CHAR_BIT == 8);
}

static void texts(void)
{
	char path[] = "/ros/msgs/std_msgs/String.msg", copy[60], *rest, *part, *list[3], *end;
	int parts = 0;
	CHECK(!strcmp(basename(strcpy(copy, path)), "String.msg"));
	CHECK(!strcmp(dirname(strcpy(copy, path)), "/ros/msgs/std_msgs"));
	CHECK(!strcmp(dirname(strcpy(copy, "a")), ".") && !strcmp(dirname(strcpy(copy, "/a")), "/"));
	CHECK(!strcmp(basename(strcpy(copy, "/a/b/")), "b"));
	CHECK(!strcmp(dirname(strcpy(copy, "/a/b/")), "/a"));
	for (part = strtok_r(path, "/", &rest); part; part = strtok_r(NULL, "/", &rest))
		if (parts < 3)
			list[parts++] = strdup(part);
	qsort(list, 3, sizeof *list, by_text);
	CHECK(parts == 3 && !strcmp(list[0], "msgs") && !strcasecmp(list[1], "ROS"));
	end = strndup(list[2], 3);
	CHECK(!strcmp(end, "std") && !strncasecmp(end, "STDX", 3));
	free(end);
	while (parts)
		free(list[--parts]);
	CHECK(index("abc", 'b') && !rindex("abc", 'x'));
	CHECK(strpbrk("a:b", ";:") && strspn("aab", "a") == 2);
	CHECK(toupper('x') == 'X' && isspace('\t') && !isalnum('_'));
}

static void times(void)
{
	struct timeval now, later, sum;
	struct timespec monotonic, none = {0, 0}, rest;
	struct tm date;
	char text[40];
	time_t t = time(NULL);
	CHECK(!gettimeofday(&now, NULL) && now.tv_sec == t);
	CHECK(!clock_gettime(CLOCK_MONOTONIC, &monotonic) && clock() != (clock_t)-1);
	later.tv_sec = 1, later.tv_usec = 999999;
	timeradd(&now, &later, &sum);
	CHECK(timercmp(&sum, &now, >));
	gmtime_r(&t, &date);
	CHECK(strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &date) == 19 && mktime(&date) == t);
	CHECK(usleep(0) == 0 && sleep(0) == 0 && nanosleep(&none, &rest) == 0);
	srand(1), srandom(2);
	unsigned seed = 3;
	CHECK(rand() >= 0 && random() >= 0 && rand_r(&seed) >= 0 && seed != 3);
}

static void system_calls(void)
{
	char name[HOST_NAME_MAX + 1];
	struct sigaction action;
	sigset_t set;
	CHECK(getpid() > 0 && getuid() == 0 && !isatty(STDOUT_FILENO));
	CHECK(!gethostname(name, sizeof name) && *name);
	CHECK(getenv("ROS_MASTER_URI") == NULL);
	CHECK(setenv("A", "b", 1) == -1 && errno == ENOSYS && fork() == -1 && system(NULL) == 0);
	memset(&action, 0, sizeof action);
	action.sa_handler = handler;
	sigemptyset(&action.sa_mask);
	CHECK(!sigaction(SIGINT, &action, NULL) && signal(SIGPIPE, SIG_IGN) != SIG_ERR);
	CHECK(!sigprocmask(SIG_BLOCK, &set, &set) && kill(4711, SIGTERM) == -1 && errno == EPERM);
	CHECK(!atexit(leave));
	errno = ENOENT;
	perror("node");
	CHECK(!strcmp(strerror(ENOENT), "no such file or folder"));
	assert(checks > 0);
}

static int lines_of(const char *path)
{
	char line[64];
	int lines = 0;
	FILE *file = fopen(path, "r");
	if (!file)
		return -errno;
	while (!feof(file) && fgets(line, sizeof line, file))
		lines += strchr(line, '\n') != NULL;
	fclose(file);
	return lines;
}

static void files(void)
{
	struct stat found;
	struct dirent *entry;
	char all[100] = "", *line = NULL;
	size_t size = 0;
	int lines = 0;
	DIR *folder = opendir("F:/geometry");
	CHECK(folder != NULL);
	while (folder && (entry = readdir(folder)) != NULL)
		strcat(strcat(all, entry->d_name), entry->d_type == DT_DIR ? "/ " : " ");
	CHECK(!strcmp(all, "./ ../ Point.msg Pose.msg old/ "));
	rewinddir(folder);
	CHECK((entry = readdir(folder)) && !strcmp(entry->d_name, "."));
	CHECK(!closedir(folder) && closedir(folder) == -1 && errno == EBADF);
	CHECK(!opendir("F:/nowhere") && errno == ENOENT);
	CHECK(!opendir("F:/geometry/Point.msg") && errno == ENOTDIR);
	CHECK(!stat("F:/geometry/Point.msg", &found) && S_ISREG(found.st_mode) && found.st_size == 20);
	CHECK(!stat("F:/geometry", &found) && S_ISDIR(found.st_mode));
	CHECK(stat("F:/x", &found) == -1 && errno == ENOENT);
	CHECK(stat("F:/../secret", &found) == -1 && errno == EACCES);
	CHECK(access("F:/geometry/Pose.msg", R_OK) == 0 && access("F:/no", F_OK) == -1);
	CHECK(lines_of("F:/geometry/Point.msg") == 2 && lines_of("F:/none") == -ENOENT);
	FILE *file = fopen("F:/geometry/Point.msg", "r");
	CHECK(!fstat(fileno(file), &found) && found.st_size == 20 && found.st_mtime > 0);
	while (getline(&line, &size, file) > 0)
		lines++;
	CHECK(lines == 2 && !strcmp(line, "float64 y\n") && feof(file));
	free(line);
	fclose(file);
	CHECK(!mkdir("F:/made", 0777) && mkdir("F:/made", 0777) == -1 && errno == EEXIST);
	int fd = open("F:/made/a.bin", O_RDWR | O_CREAT | O_TRUNC, 0666);
	CHECK(fd > 2 && write(fd, "abcdef", 6) == 6 && lseek(fd, 2, SEEK_SET) == 2);
	CHECK(read(fd, all, 3) == 3 && !memcmp(all, "cde", 3) && lseek(fd, 0, SEEK_END) == 6);
	CHECK(!fstat(fd, &found) && found.st_size == 6);
	CHECK(!close(fd) && close(fd) == -1 && errno == EBADF);
	CHECK(read(fd, all, 1) == -1 && write(STDOUT_FILENO, "raw\n", 4) == 4);
	CHECK(rmdir("F:/made") == -1 && errno == ENOTEMPTY);
	CHECK(!unlink("F:/made/a.bin") && !rmdir("F:/made"));
	CHECK(open("F:/no/b", O_RDONLY) == -1 && errno == ENOENT);
}

static void network(void)
{
	struct sockaddr_in address;
	struct addrinfo hints, *found = NULL;
	struct in_addr in;
	struct hostent *host;
	char text[INET6_ADDRSTRLEN], port[NI_MAXSERV];
	memset(&hints, 0, sizeof hints);
	hints.ai_family = AF_INET;
	hints.ai_socktype = SOCK_STREAM;
	CHECK(!getaddrinfo("localhost", "11311", &hints, &found) && found->ai_family == AF_INET);
	memcpy(&address, found->ai_addr, sizeof address);
	CHECK(ntohs(address.sin_port) == 11311 && address.sin_addr.s_addr == htonl(INADDR_LOOPBACK));
	CHECK(inet_ntop(AF_INET, &address.sin_addr, text, sizeof text) && !strcmp(text, "127.0.0.1"));
	CHECK(!getnameinfo(found->ai_addr, found->ai_addrlen, text, sizeof text, port, sizeof port,
		NI_NUMERICHOST | NI_NUMERICSERV) && !strcmp(port, "11311"));
	freeaddrinfo(found);
	CHECK(getaddrinfo("robot", NULL, &hints, &found) == EAI_NONAME && *gai_strerror(EAI_NONAME));
	CHECK(inet_pton(AF_INET, "10.1.2.3", &in) == 1 && !strcmp(inet_ntoa(in), "10.1.2.3"));
	CHECK(inet_pton(AF_INET, "10.1.2", &in) == 0 && inet_pton(AF_INET, "1.2.3.256", &in) == 0);
	CHECK(inet_addr("1.2.3.4.5") == INADDR_NONE && !inet_ntop(AF_INET, &in, text, 3));
	CHECK((host = gethostbyname("10.0.0.1")) && host->h_length == 4 && !gethostbyname("x"));
	errno = 0;
	CHECK(socket(AF_INET, SOCK_STREAM, 0) == -1 && errno == ENOSYS);
	CHECK(be32toh(0x01020304) == 0x04030201 && MAX(2, 3) == 3);
}

static int started;
static void start(void) { started++; }

static void threads(void)
{
	static pthread_once_t done = PTHREAD_ONCE_INIT;
	pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER, again;
	pthread_mutexattr_t kind = 1;
	CHECK(!pthread_mutex_lock(&mutex) && pthread_mutex_trylock(&mutex) == EBUSY);
	CHECK(!pthread_mutex_unlock(&mutex) && pthread_mutex_unlock(&mutex) == EPERM);
	CHECK(!pthread_mutexattr_init(&kind) && !kind);
	CHECK(!pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE));
	CHECK(!pthread_mutex_init(&again, &kind) && !pthread_mutex_lock(&again));
	CHECK(!pthread_mutex_lock(&again));
	CHECK(pthread_mutex_destroy(&again) == EBUSY);
	CHECK(!pthread_once(&done, start) && !pthread_once(&done, start) && started == 1);
	CHECK(pthread_equal(pthread_self(), pthread_self()) && !sched_yield());
}

static void options(void)
{
	char *given[] = {"p", "-a", "-bval", "-xc", "-b", "next", "--", "file"};
	optind = 1, opterr = 0;
	CHECK(getopt(8, given, "ab:c") == 'a' && !optarg);
	CHECK(getopt(8, given, "ab:c") == 'b' && !strcmp(optarg, "val"));
	CHECK(getopt(8, given, "ab:c") == '?' && optopt == 'x' && getopt(8, given, "ab:c") == 'c');
	CHECK(getopt(8, given, "ab:c") == 'b' && !strcmp(optarg, "next"));
	CHECK(getopt(8, given, "ab:c") == -1 && optind == 7);
	optind = 4;
	CHECK(getopt(5, given, ":b:") == ':' && optopt == 'b');
}

static void areas(void)
{
	void *area[60];
	unsigned seed = 7;
	for (unsigned i = 0; i < 60; i++) {
		size_t alignment = 1u << rand_r(&seed) % 11, size = rand_r(&seed) % 500u + 1;
		area[i] = aligned_alloc(alignment, size);
		CHECK(area[i] && !((uintptr_t)area[i] % alignment));
		memset(area[i], 0xA5, size);
		if (i % 3 == 1) {
			free(area[i - 1]);
			area[i - 1] = NULL;
		}
		if (i % 5 == 2)
			area[i] = realloc(area[i], 700);
	}
	for (unsigned i = 0; i < 60; i++)
		free(area[i]);
	CHECK(!aligned_alloc(3, 4) && !aligned_alloc(16, (size_t)-9));
	CHECK(!aligned_alloc(0x80000000, 1));
	CHECK(!posix_memalign(area, 64, 100) && !((uintptr_t)area[0] % 64));
	free(area[0]);
	CHECK(!reallocarray(NULL, 0x10000, 0x10001));
	CHECK(ffs(0) == 0 && ffs(8) == 4 && ffsl(1) == 1 && ffsll(1ll << 40) == 41);
	CHECK(!*strchrnul("abc", 'z') && *strchrnul("abc", 'b') == 'b');
	CHECK(isascii('a') && !isascii(0x80) && toascii(0xE1) == 'a' && bswap_16(0x1234) == 0x3412);
}

void _CYCLIC run(void)
{
	DynBuffer buffer = {NULL, 0, 0, 0};
	cRosErrCodePack error = 0;
	out_stream = stdout;
	failed = checks = 0;
	for (uint16_t i = 0; i < 100; i++)
		if (push(&buffer, &i, sizeof i) < 0)
			error = (error << 8) | 1u;
	CHECK(buffer.size == 200 && error == 0);
	free(buffer.data);
	formats();
	texts();
	times();
	system_calls();
	files();
	network();
	threads();
	options();
	areas();
	LOG(INFO, "node %s has %lu of %zu, %.1f %%", "/talker", 3ul, (size_t)5, 60.0);
}
"""
SOURCE = "".join(f"#include <{name}.h>\n" for name in HEADERS.split()) + NODE
FILES = {
    "plc.toml": PLC,
    "main/main.c": SOURCE,
    "messages/geometry/Point.msg": "float64 x\nfloat64 y\n",
    "messages/geometry/Pose.msg": "Point position\n",
    "messages/geometry/old/Point.msg": "float32 x\n",
}


@pytest.mark.parametrize("compiler", [zig, system_clang], ids=["zig", "clang"])
def test_what_a_port_uses_of_posix_is_there(run, value, compiler, monkeypatch, capfd):
    if compiler() is None:
        pytest.skip("this compiler is not installed")
    monkeypatch.setattr("plcsim.program.c.sources.find_toolchain", compiler)
    controller = run(FILES, cycles=3)
    assert controller.state is State.RUN, controller.fault
    lines = [f"{n}: {SOURCE.splitlines()[n - 1]}" for n in value(controller, "main.wrong") if n]
    assert not lines, "\n".join(lines)
    assert value(controller, "main.checks") > 70
    assert value(controller, "main.printed") == "node /talker has 3 of 5, 60.0 %"
    assert value(controller, "main.plc_heap.Areas") == 0
    out, err = capfd.readouterr()
    assert out.splitlines()[:2] == ["raw", out.splitlines()[1]]
    assert out.splitlines()[1].endswith(": node /talker has 3 of 5, 60.0 %")
    assert "node: no such file or folder" in err


def test_a_call_for_a_socket_is_warned_of(project):
    text = "#include <bur/plctypes.h>\n#include <sys/socket.h>\nint file;\n"
    text += "void _CYCLIC run(void)\n{\n\tfile = socket(2, 1, 0);\n}\n"
    application = load(read_project(project(FILES | {"main/main.c": text})))
    (warning,) = [w for w in application.warnings if "socket fails" in w]
    application.unload()
    assert "main.c:6:9: " in warning
    assert "TCP is the library AsTCP" in warning
