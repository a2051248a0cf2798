/* What programs use of POSIX, of locales and of signals. */

#include <errno.h>
#include <locale.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/ioctl.h>
#include <sys/time.h>
#include <unistd.h>

#include "host.h"

int ffs(int value) { return value ? __builtin_ctz((unsigned)value) + 1 : 0; }
int ffsl(long value) { return ffs((int)value); }
int ffsll(long long value) { return value ? __builtin_ctzll((unsigned long long)value) + 1 : 0; }

int access(const char *path, int mode)
{
	FILE *file = fopen(path, mode & W_OK ? "r+" : "r");
	return file ? fclose(file) : -1;
}

int unlink(const char *path) { return remove(path); }
pid_t getpid(void) { return 1; }
pid_t getppid(void) { return 0; }
uid_t getuid(void) { return 0; }
uid_t geteuid(void) { return 0; }
gid_t getgid(void) { return 0; }
gid_t getegid(void) { return 0; }
unsigned alarm(unsigned seconds) { return (void)seconds, 0u; }
long sysconf(int name) { return (void)name, -1; }

static int not_there(void)
{
	errno = ENOSYS;
	return -1;
}

int chdir(const char *path) { return (void)path, not_there(); }
int dup(int file) { return (void)file, not_there(); }
int dup2(int file, int other) { return (void)file, (void)other, not_there(); }
int pipe(int files[2]) { return (void)files, not_there(); }
pid_t fork(void) { return not_there(); }
int system(const char *command) { return command ? not_there() : 0; }
int putenv(char *text) { return (void)text, not_there(); }
int unsetenv(const char *name) { return (void)name, not_there(); }

int setenv(const char *name, const char *value, int replace)
{
	return (void)name, (void)value, (void)replace, not_there();
}
int ioctl(int file, unsigned long request, ...) { return (void)file, (void)request, not_there(); }
int isatty(int file) { return (void)file, 0; }

int gethostname(char *name, size_t size)
{
	return strlcpy(name, "plc", size) < size ? 0 : -1;
}

#define NO_WAITING " was called: a unit never waits, what it waits for comes in a later cycle"

unsigned sleep(unsigned seconds)
{
	if (seconds)
		plc_fault("sleep" NO_WAITING);
	return 0;
}

int usleep(useconds_t time)
{
	if (time)
		plc_fault("usleep" NO_WAITING);
	return 0;
}

int nanosleep(const struct timespec *time, struct timespec *rest)
{
	if (time->tv_sec || time->tv_nsec)
		plc_fault("nanosleep" NO_WAITING);
	if (rest)
		*rest = *time;
	return 0;
}

void _exit(int status) { exit(status); }
void _Exit(int status) { exit(status); }
int atexit(void (*function)(void)) { return (void)function, 0; }

char *setlocale(int category, const char *locale)
{
	(void)category;
	return !locale || !*locale || !strcmp(locale, "C") || !strcmp(locale, "POSIX") ? (char *)"C" : 0;
}

struct lconv *localeconv(void)
{
	static char point[] = ".", none[] = "";
	static struct lconv c = {
		point, none, none, none, none, none, none, none, none, none, 127, 127, 127, 127, 127, 127, 127, 127,
	};
	return &c;
}

int sigaction(int number, const struct sigaction *action, struct sigaction *before)
{
	(void)number, (void)action;
	if (before)
		memset(before, 0, sizeof *before);
	return 0;
}

int sigprocmask(int how, const sigset_t *set, sigset_t *before)
{
	(void)how, (void)set;
	return before ? sigemptyset(before) : 0;
}

int sigemptyset(sigset_t *set) { return *set = 0, 0; }
int sigfillset(sigset_t *set) { return *set = ~0ul, 0; }
int sigaddset(sigset_t *set, int number) { return *set |= 1ul << (number - 1 & 31), 0; }
int sigdelset(sigset_t *set, int number) { return *set &= ~(1ul << (number - 1 & 31)), 0; }
int sigismember(const sigset_t *set, int number) { return (int)(*set >> (number - 1 & 31) & 1); }

int kill(int process, int number)
{
	if (process == getpid() && number)
		return raise(number);
	errno = EPERM;
	return process == getpid() ? 0 : -1;
}

void (*signal(int number, void (*handler)(int)))(int) { return (void)number, (void)handler, SIG_DFL; }

char *strsignal(int number)
{
	static char text[24];
	snprintf(text, sizeof text, "signal %d", number);
	return text;
}

int raise(int number)
{
	static char text[40];
	snprintf(text, sizeof text, "raise was called, with signal %d", number);
	plc_fault(text);
}

/* Paths of the C library begin at a device, so the current folder has no name. */
char *getcwd(char *path, size_t size)
{
	return path && strlcpy(path, "", size) < size ? path : (char *)0;
}
