/* Date and time of the controller (ISO C 7.23). Both stand still within a cycle; local time is UTC. */

#ifndef PLCSIM_TIME_H
#define PLCSIM_TIME_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef long time_t;
typedef unsigned long clock_t;

typedef int clockid_t;

#define CLOCKS_PER_SEC 1000000
#define CLOCK_REALTIME 0
#define CLOCK_MONOTONIC 1
#define CLOCK_PROCESS_CPUTIME_ID 2
#define CLOCK_THREAD_CPUTIME_ID 3
#define CLOCK_MONOTONIC_RAW 4
#define CLOCK_REALTIME_COARSE 5
#define CLOCK_MONOTONIC_COARSE 6
#define CLOCK_BOOTTIME 7

struct tm {
	int tm_sec, tm_min, tm_hour, tm_mday, tm_mon, tm_year, tm_wday, tm_yday, tm_isdst;
};

struct timespec {
	time_t tv_sec;
	long tv_nsec;
};

int clock_gettime(clockid_t clock, struct timespec *now);
int clock_getres(clockid_t clock, struct timespec *resolution);
int nanosleep(const struct timespec *time, struct timespec *rest); /* a fault: units do not wait */
time_t time(time_t *where);
clock_t clock(void);
double difftime(time_t end, time_t start);
time_t mktime(struct tm *date);
time_t timegm(struct tm *date);
void tzset(void);
struct tm *gmtime(const time_t *when);
struct tm *localtime(const time_t *when);
struct tm *gmtime_r(const time_t *when, struct tm *date);
struct tm *localtime_r(const time_t *when, struct tm *date);
char *asctime(const struct tm *date);
char *ctime(const time_t *when);
char *asctime_r(const struct tm *date, char *text);
char *ctime_r(const time_t *when, char *text);
size_t strftime(char *text, size_t size, const char *format, const struct tm *date);

#ifdef __cplusplus
}
#endif

#endif
