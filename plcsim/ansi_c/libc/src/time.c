/* Date and time. Dates are counted in days of the Gregorian calendar, whose 400 years have 146,097. */

#include <stdio.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>

#define DAY 86400
#define SECOND 1000000000LL

/* Cells of the system area (plcsim/core/system_area.py). */
#define RELEASE (*(volatile const long long *)0x100008)
#define DATE (*(volatile const long long *)0x100010)

/* Nanoseconds since 1970-01-01. */
static long long plc_date(void) { return RELEASE + DATE; }

time_t time(time_t *where)
{
	time_t now = (time_t)(plc_date() / SECOND);
	if (where)
		*where = now;
	return now;
}

int gettimeofday(struct timeval *now, void *zone)
{
	if (now) {
		now->tv_sec = (time_t)(plc_date() / SECOND);
		now->tv_usec = (suseconds_t)(plc_date() % SECOND / 1000);
	}
	if (zone)
		memset(zone, 0, sizeof(struct timezone));
	return 0;
}

int clock_gettime(clockid_t clock, struct timespec *now)
{
	long long time = clock == CLOCK_REALTIME ? plc_date() : RELEASE;
	now->tv_sec = (time_t)(time / SECOND);
	now->tv_nsec = (long)(time % SECOND);
	return 0;
}

int clock_getres(clockid_t clock, struct timespec *resolution)
{
	(void)clock;
	if (resolution)
		*resolution = (struct timespec){0, 1};
	return 0;
}

void tzset(void) {}
time_t timegm(struct tm *date) { return mktime(date); }

clock_t clock(void) { return (clock_t)(plc_date() / (SECOND / CLOCKS_PER_SEC)); }
double difftime(time_t end, time_t start) { return (double)end - (double)start; }

static long long floor_divide(long long number, long long by)
{
	return number / by - (number % by < 0);
}

/* Returns the days from 1970-01-01 to the first of a month; months are counted from January, 0. */
static long long days_to(long long year, long long month)
{
	year += floor_divide(month, 12);
	month -= 12 * floor_divide(month, 12);
	/* years begin with March, so that the leap day is their last */
	year -= month < 2;
	long long from_march = (month + 10) % 12;
	long long leaps = floor_divide(year, 4) - floor_divide(year, 100) + floor_divide(year, 400);
	return 365 * year + leaps + (153 * from_march + 2) / 5 - 719468;
}

static int is_leap(long long year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); }

static void set_date(long long when, struct tm *date)
{
	long long day = floor_divide(when, DAY);
	int rest = (int)(when - DAY * day);
	long long year = 1970 + floor_divide(day, 366); /* not after the right one in this century */
	while (days_to(year + 1, 0) <= day)
		year++;
	while (days_to(year, 0) > day)
		year--;
	int month = 0;
	while (days_to(year, month + 1) <= day)
		month++;
	date->tm_sec = rest % 60;
	date->tm_min = rest / 60 % 60;
	date->tm_hour = rest / 3600;
	date->tm_mday = (int)(day - days_to(year, month)) + 1;
	date->tm_mon = month;
	date->tm_year = (int)(year - 1900);
	date->tm_wday = (int)((day % 7 + 11) % 7); /* 1970-01-01 was a Thursday */
	date->tm_yday = (int)(day - days_to(year, 0));
	date->tm_isdst = 0;
}

time_t mktime(struct tm *date)
{
	long long days = days_to(date->tm_year + 1900LL, date->tm_mon) + date->tm_mday - 1;
	long long when = ((days * 24 + date->tm_hour) * 60 + date->tm_min) * 60 + date->tm_sec;
	if (when != (time_t)when)
		return -1;
	set_date(when, date);
	return (time_t)when;
}

struct tm *gmtime_r(const time_t *when, struct tm *date)
{
	set_date(*when, date);
	return date;
}

struct tm *localtime_r(const time_t *when, struct tm *date) { return gmtime_r(when, date); }

struct tm *gmtime(const time_t *when)
{
	static struct tm date;
	return gmtime_r(when, &date);
}

struct tm *localtime(const time_t *when) { return gmtime(when); }

static const char *const days[] = {
	"Sunday", "Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday"};
static const char *const months[] = {
	"January", "February", "March", "April", "May", "June",
	"July", "August", "September", "October", "November", "December"};

static const char *name_of(const char *const *names, int count, int number)
{
	return number >= 0 && number < count ? names[number] : "?";
}

#define DATE_TEXT 26 /* as POSIX has it */

char *asctime_r(const struct tm *date, char *text)
{
	snprintf(text, DATE_TEXT, "%.3s %.3s %2d %02d:%02d:%02d %d\n",
	         name_of(days, 7, date->tm_wday), name_of(months, 12, date->tm_mon), date->tm_mday,
	         date->tm_hour, date->tm_min, date->tm_sec, date->tm_year + 1900);
	return text;
}

char *asctime(const struct tm *date)
{
	static char text[DATE_TEXT];
	return asctime_r(date, text);
}

char *ctime(const time_t *when) { return asctime(gmtime(when)); }

char *ctime_r(const time_t *when, char *text)
{
	struct tm date;
	return asctime_r(gmtime_r(when, &date), text);
}

/* Returns the year that a week belongs to (ISO 8601), and its number. */
static int iso_week(const struct tm *date, int *year)
{
	int monday = (date->tm_wday + 6) % 7, week = (date->tm_yday - monday + 10) / 7;
	*year = date->tm_year + 1900;
	if (week < 1) {
		--*year;
		int last = date->tm_yday + 365 + is_leap(*year);
		return (last - monday + 10) / 7;
	}
	if (week == 53 && date->tm_yday - monday + 3 >= 365 + is_leap(*year)) {
		++*year;
		return 1;
	}
	return week;
}

static int format_one(char *to, size_t size, char kind, const struct tm *t)
{
	int year, hour = t->tm_hour % 12 ? t->tm_hour % 12 : 12;
	switch (kind) {
	case 'a': return snprintf(to, size, "%.3s", name_of(days, 7, t->tm_wday));
	case 'A': return snprintf(to, size, "%s", name_of(days, 7, t->tm_wday));
	case 'b':
	case 'h': return snprintf(to, size, "%.3s", name_of(months, 12, t->tm_mon));
	case 'B': return snprintf(to, size, "%s", name_of(months, 12, t->tm_mon));
	case 'c': return (int)strftime(to, size, "%a %b %e %H:%M:%S %Y", t);
	case 'C': return snprintf(to, size, "%02d", (t->tm_year + 1900) / 100);
	case 'd': return snprintf(to, size, "%02d", t->tm_mday);
	case 'D':
	case 'x': return (int)strftime(to, size, "%m/%d/%y", t);
	case 'e': return snprintf(to, size, "%2d", t->tm_mday);
	case 'F': return (int)strftime(to, size, "%Y-%m-%d", t);
	case 'g': return iso_week(t, &year), snprintf(to, size, "%02d", year % 100);
	case 'G': return iso_week(t, &year), snprintf(to, size, "%d", year);
	case 'H': return snprintf(to, size, "%02d", t->tm_hour);
	case 'I': return snprintf(to, size, "%02d", hour);
	case 'j': return snprintf(to, size, "%03d", t->tm_yday + 1);
	case 'm': return snprintf(to, size, "%02d", t->tm_mon + 1);
	case 'M': return snprintf(to, size, "%02d", t->tm_min);
	case 'n': return snprintf(to, size, "\n");
	case 'p': return snprintf(to, size, "%s", t->tm_hour < 12 ? "AM" : "PM");
	case 'r': return (int)strftime(to, size, "%I:%M:%S %p", t);
	case 'R': return (int)strftime(to, size, "%H:%M", t);
	case 'S': return snprintf(to, size, "%02d", t->tm_sec);
	case 't': return snprintf(to, size, "\t");
	case 'T':
	case 'X': return (int)strftime(to, size, "%H:%M:%S", t);
	case 'u': return snprintf(to, size, "%d", t->tm_wday ? t->tm_wday : 7);
	case 'U': return snprintf(to, size, "%02d", (t->tm_yday + 7 - t->tm_wday) / 7);
	case 'V': return snprintf(to, size, "%02d", iso_week(t, &year));
	case 'w': return snprintf(to, size, "%d", t->tm_wday);
	case 'W': return snprintf(to, size, "%02d", (t->tm_yday + 7 - (t->tm_wday + 6) % 7) / 7);
	case 'y': return snprintf(to, size, "%02d", (t->tm_year + 1900) % 100);
	case 'Y': return snprintf(to, size, "%d", t->tm_year + 1900);
	case 'z': return snprintf(to, size, "+0000");
	case 'Z': return snprintf(to, size, "UTC");
	default: return snprintf(to, size, "%c", kind);
	}
}

size_t strftime(char *text, size_t size, const char *format, const struct tm *date)
{
	size_t used = 0;
	for (; *format; format++) {
		char one[64];
		int length = 1;
		one[0] = *format;
		if (*format == '%' && format[1]) {
			format++;
			if ((*format == 'E' || *format == 'O') && format[1])
				format++;
			length = format_one(one, sizeof one, *format, date);
		}
		if (used + (size_t)length >= size)
			return 0;
		memcpy(text + used, one, (size_t)length);
		used += (size_t)length;
	}
	text[used] = 0;
	return used;
}
