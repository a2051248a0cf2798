/* What programs use of POSIX, of locales and of signals. */

#include <locale.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#include "host.h"

int access(const char *path, int mode)
{
	FILE *file = fopen(path, mode & W_OK ? "r+" : "r");
	return file ? fclose(file) : -1;
}

int unlink(const char *path) { return remove(path); }
pid_t getpid(void) { return 1; }
pid_t getppid(void) { return 0; }
int isatty(int file) { return (void)file, 0; }

int gethostname(char *name, size_t size)
{
	return strlcpy(name, "plc", size) < size ? 0 : -1;
}

#define NO_WAITING " was called: a unit never waits, what it waits for comes in a later cycle"

unsigned sleep(unsigned seconds) { (void)seconds, plc_fault("sleep" NO_WAITING); }
int usleep(useconds_t time) { (void)time, plc_fault("usleep" NO_WAITING); }

int nanosleep(const struct timespec *time, struct timespec *rest)
{
	(void)time, (void)rest;
	plc_fault("nanosleep" NO_WAITING);
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
