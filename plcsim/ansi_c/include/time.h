/* Date and time of the controller (ISO C 7.23). Both stand still within a cycle; local time is UTC. */

#ifndef PLCSIM_TIME_H
#define PLCSIM_TIME_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef long time_t;
typedef unsigned long clock_t;

#define CLOCKS_PER_SEC 1000000

struct tm {
	int tm_sec, tm_min, tm_hour, tm_mday, tm_mon, tm_year, tm_wday, tm_yday, tm_isdst;
};

struct timespec {
	time_t tv_sec;
	long tv_nsec;
};

time_t time(time_t *where);
clock_t clock(void);
double difftime(time_t end, time_t start);
time_t mktime(struct tm *date);
struct tm *gmtime(const time_t *when);
struct tm *localtime(const time_t *when);
struct tm *gmtime_r(const time_t *when, struct tm *date);
struct tm *localtime_r(const time_t *when, struct tm *date);
char *asctime(const struct tm *date);
char *ctime(const time_t *when);
size_t strftime(char *text, size_t size, const char *format, const struct tm *date);

#ifdef __cplusplus
}
#endif

#endif
