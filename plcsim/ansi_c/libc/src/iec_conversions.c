/* Every conversion of the controller's library AsIecCon, each as iec_X_to_y.
 *
 * Numbers become numbers as C casts them, a REAL is rounded half away from zero first; what becomes
 * a BOOL is TRUE where it is not 0. Texts have the form of literals: TRUE, T#1s500ms,
 * DT#2026-03-31-06:00:00, D#2026-03-31, TOD#06:00:00; what cannot be read is 0. A text result is
 * written to the address that comes first. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>

#define SECONDS_OF_DAY 86400u
#define TEXT 81 /* bytes of a STRING[80] */

typedef unsigned char BOOL, BYTE, USINT;
typedef signed char SINT;
typedef short INT;
typedef unsigned short UINT, WORD;
typedef int DINT, TIME;
typedef unsigned UDINT, DWORD, DT, DATE, TOD;
typedef float REAL;
typedef double LREAL;

/* Numbers */

static double rounded(double x) { return x >= 0 ? x + 0.5 : x - 0.5; }

#define WHOLE(X, Y) \
	Y iec_##X##_to_##Y(X value) { return (Y)value; }
#define ROUNDED(X, Y) \
	Y iec_##X##_to_##Y(X value) { return (Y)(long long)rounded(value); }
#define ROUNDED_INT(X, Y) \
	Y iec_##X##_to_##Y(X value) { return (Y)(int)rounded(value); }
#define TRUTH(X) \
	BOOL iec_##X##_to_BOOL(X value) { return value != 0; }
#define FROM_BOOL(Y) \
	Y iec_BOOL_to_##Y(BOOL value) { return (Y)(value & 1); }

#define OTHERS(M, X) M(X, REAL) M(X, LREAL)
#define TO_SMALL(M, X) M(X, SINT) M(X, INT) M(X, USINT) M(X, UINT) M(X, BYTE) M(X, WORD)
#define TO_SIGNED(M, X) M(X, DINT) M(X, TIME)
#define TO_UNSIGNED(M, X) M(X, UDINT) M(X, DWORD)

#define FROM_WHOLE(X) \
	TRUTH(X) TO_SMALL(WHOLE, X) TO_SIGNED(WHOLE, X) TO_UNSIGNED(WHOLE, X) OTHERS(WHOLE, X)
#define FROM_NUMBER(X) FROM_WHOLE(X) WHOLE(X, DT) WHOLE(X, DATE) WHOLE(X, TOD)
#define FROM_REAL(X) \
	TRUTH(X) TO_SMALL(ROUNDED_INT, X) TO_SIGNED(ROUNDED_INT, X) TO_UNSIGNED(ROUNDED, X) \
	OTHERS(WHOLE, X) ROUNDED(X, DT) ROUNDED(X, DATE) ROUNDED(X, TOD)

FROM_NUMBER(SINT)
FROM_NUMBER(INT)
FROM_NUMBER(DINT)
FROM_NUMBER(USINT)
FROM_NUMBER(UINT)
FROM_NUMBER(UDINT)
FROM_NUMBER(BYTE)
FROM_NUMBER(WORD)
FROM_NUMBER(DWORD)
FROM_NUMBER(TIME)
FROM_WHOLE(DT)
FROM_WHOLE(DATE)
FROM_WHOLE(TOD)
WHOLE(DATE, DT)
WHOLE(DATE, TOD)
WHOLE(TOD, DT)
WHOLE(TOD, DATE)
FROM_REAL(REAL)
FROM_REAL(LREAL)

FROM_BOOL(SINT)
FROM_BOOL(INT)
FROM_BOOL(DINT)
FROM_BOOL(USINT)
FROM_BOOL(UINT)
FROM_BOOL(UDINT)
FROM_BOOL(BYTE)
FROM_BOOL(WORD)
FROM_BOOL(DWORD)
FROM_BOOL(TIME)
FROM_BOOL(DT)
FROM_BOOL(DATE)
FROM_BOOL(TOD)
FROM_BOOL(REAL)
FROM_BOOL(LREAL)

DATE iec_DT_to_DATE(DT value) { return value - value % SECONDS_OF_DAY; }
TOD iec_DT_to_TOD(DT value) { return value % SECONDS_OF_DAY * 1000; }

/* The order of bytes */

UINT plc_swap16(UINT value) { return __builtin_bswap16(value); }
INT plc_swap16s(INT value) { return (INT)__builtin_bswap16((UINT)value); }
UDINT plc_swap32(UDINT value) { return __builtin_bswap32(value); }

REAL plc_swap_real(REAL value)
{
	UDINT bits;
	memcpy(&bits, &value, sizeof bits);
	bits = __builtin_bswap32(bits);
	memcpy(&value, &bits, sizeof bits);
	return value;
}

LREAL plc_swap_lreal(LREAL value)
{
	unsigned long long bits;
	memcpy(&bits, &value, sizeof bits);
	bits = __builtin_bswap64(bits);
	memcpy(&value, &bits, sizeof bits);
	return value;
}

/* To texts */

static void write_bool(char *target, BOOL value) { strcpy(target, value & 1 ? "TRUE" : "FALSE"); }
static void write_signed(char *target, DINT value) { sprintf(target, "%d", value); }
static void write_unsigned(char *target, UDINT value) { sprintf(target, "%u", value); }
static void write_real(char *target, REAL value) { sprintf(target, "%.7g", (double)value); }
static void write_lreal(char *target, LREAL value) { sprintf(target, "%.15g", value); }

static void write_time(char *target, TIME value)
{
	static const struct {
		const char *name;
		unsigned length;
	} units[] = {{"d", 86400000}, {"h", 3600000}, {"m", 60000}, {"s", 1000}, {"ms", 1}};
	unsigned rest = value < 0 ? 0u - (unsigned)value : (unsigned)value;
	target += sprintf(target, "T#%s", value < 0 ? "-" : "");
	if (!rest)
		strcpy(target, "0ms");
	for (int index = 0; index < 5; index++) {
		unsigned count = rest / units[index].length;
		rest -= count * units[index].length;
		if (count)
			target += sprintf(target, "%u%s", count, units[index].name);
	}
}

static struct tm parts(UDINT seconds)
{
	struct tm result;
	time_t when = (time_t)seconds;
	gmtime_r(&when, &result);
	return result;
}

static void write_dt(char *target, DT value)
{
	struct tm date = parts(value);
	strftime(target, TEXT, "DT#%Y-%m-%d-%H:%M:%S", &date);
}

static void write_date(char *target, DATE value)
{
	struct tm date = parts(value);
	strftime(target, TEXT, "D#%Y-%m-%d", &date);
}

static void write_tod(char *target, TOD value)
{
	unsigned seconds = value / 1000;
	target += sprintf(target, "TOD#%02u:%02u:%02u", seconds / 3600, seconds / 60 % 60, seconds % 60);
	if (value % 1000)
		sprintf(target, ".%03u", value % 1000);
}

static void widen(UINT *target, const char *text)
{
	while ((*target++ = (unsigned char)*text++))
		;
}

#define TO_TEXT(X, WRITE) \
	void iec_##X##_to_STRING(char *target, X value) { WRITE(target, value); } \
	void iec_##X##_to_WSTRING(UINT *target, X value) \
	{ \
		char text[TEXT]; \
		WRITE(text, value); \
		widen(target, text); \
	}

TO_TEXT(BOOL, write_bool)
TO_TEXT(SINT, write_signed)
TO_TEXT(INT, write_signed)
TO_TEXT(DINT, write_signed)
TO_TEXT(USINT, write_unsigned)
TO_TEXT(UINT, write_unsigned)
TO_TEXT(UDINT, write_unsigned)
TO_TEXT(BYTE, write_unsigned)
TO_TEXT(WORD, write_unsigned)
TO_TEXT(DWORD, write_unsigned)
TO_TEXT(REAL, write_real)
TO_TEXT(LREAL, write_lreal)
TO_TEXT(TIME, write_time)
TO_TEXT(DT, write_dt)
TO_TEXT(DATE, write_date)
TO_TEXT(TOD, write_tod)

void iec_STRING_to_WSTRING(UINT *target, const char *text)
{
	int count = 0;
	while (count < TEXT - 1 && text[count])
		target[count] = (unsigned char)text[count], count++;
	target[count] = 0;
}

void iec_WSTRING_to_STRING(char *target, const UINT *text)
{
	int count = 0;
	while (count < TEXT - 1 && text[count])
		target[count] = text[count] < 0x100 ? (char)text[count] : '?', count++;
	target[count] = 0;
}

/* From texts */

/* Returns what stands behind `NAME#`, or the text where that is not there. */
static const char *behind(const char *text, const char *name)
{
	size_t length = strlen(name);
	return strncasecmp(text, name, length) == 0 && text[length] == '#' ? text + length + 1 : text;
}

/* Returns a whole number; 2#, 8# and 16# are bases. */
static long long read_whole(const char *text)
{
	char *end;
	long long value = strtoll(text, &end, 10);
	if (*end == '#' && (value == 2 || value == 8 || value == 16))
		value = strtoll(end + 1, 0, (int)value);
	return value;
}

static BOOL read_bool(const char *text)
{
	return strcasecmp(text, "TRUE") == 0 || read_whole(text) != 0;
}

static REAL read_real(const char *text) { return strtof(text, 0); }
static LREAL read_lreal(const char *text) { return strtod(text, 0); }

/* Returns milliseconds of T#1h2m3s4ms; of a number alone, that number. */
static TIME read_time(const char *text)
{
	static const struct {
		const char *name;
		double length;
	} units[] = {{"ms", 1}, {"d", 86400000}, {"h", 3600000}, {"m", 60000}, {"s", 1000}};
	const char *at = behind(behind(text, "T"), "TIME");
	double sum = 0, sign = *at == '-' ? -1 : 1;
	if (at == text)
		return (TIME)read_whole(text);
	at += *at == '-';
	for (;;) {
		char *end;
		double count = strtod(at, &end);
		int index = 0;
		while (index < 5 && strncasecmp(end, units[index].name, strlen(units[index].name)))
			index++;
		if (end == at || index == 5)
			return (TIME)rounded(sign * sum);
		sum += count * units[index].length;
		at = end + strlen(units[index].name);
		at += *at == '_';
	}
}

static TOD read_clock(const char *text)
{
	int hour = 0, minute = 0;
	double second = 0;
	sscanf(text, "%d:%d:%lf", &hour, &minute, &second);
	return (TOD)((hour * 60 + minute) * 60) * 1000 + (TOD)rounded(second * 1000);
}

static TOD read_tod(const char *text)
{
	return read_clock(behind(behind(text, "TOD"), "TIME_OF_DAY"));
}

/* Returns seconds of 2026-03-31; `rest` is what stands behind. */
static DATE read_day(const char *text, const char **rest)
{
	struct tm date = {0};
	int length = 0;
	*rest = "";
	if (sscanf(text, "%d-%d-%d%n", &date.tm_year, &date.tm_mon, &date.tm_mday, &length) != 3)
		return 0;
	*rest = text + length;
	date.tm_year -= 1900;
	date.tm_mon--;
	return (DATE)mktime(&date);
}

static DATE read_date(const char *text)
{
	const char *rest;
	return read_day(behind(behind(text, "D"), "DATE"), &rest);
}

static DT read_dt(const char *text)
{
	const char *rest;
	DT day = read_day(behind(behind(text, "DT"), "DATE_AND_TIME"), &rest);
	return *rest == '-' || *rest == ' ' ? day + read_clock(rest + 1) / 1000 : day;
}

static void narrow(char *target, const UINT *text) { iec_WSTRING_to_STRING(target, text); }

#define FROM_TEXT(Y, READ) \
	Y iec_STRING_to_##Y(const char *text) { return (Y)READ(text); } \
	Y iec_WSTRING_to_##Y(const UINT *wide) \
	{ \
		char text[TEXT]; \
		narrow(text, wide); \
		return (Y)READ(text); \
	}

FROM_TEXT(BOOL, read_bool)
FROM_TEXT(SINT, read_whole)
FROM_TEXT(INT, read_whole)
FROM_TEXT(DINT, read_whole)
FROM_TEXT(USINT, read_whole)
FROM_TEXT(UINT, read_whole)
FROM_TEXT(UDINT, read_whole)
FROM_TEXT(BYTE, read_whole)
FROM_TEXT(WORD, read_whole)
FROM_TEXT(DWORD, read_whole)
FROM_TEXT(REAL, read_real)
FROM_TEXT(LREAL, read_lreal)
FROM_TEXT(TIME, read_time)
FROM_TEXT(DT, read_dt)
FROM_TEXT(DATE, read_date)
FROM_TEXT(TOD, read_tod)
