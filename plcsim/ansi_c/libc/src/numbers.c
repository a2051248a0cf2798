/* Numbers out of texts. */

#include <inttypes.h>
#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "decimal.h"

typedef unsigned long long u64;

static int digit_of(char c)
{
	if (isdigit((unsigned char)c))
		return c - '0';
	return isalpha((unsigned char)c) ? tolower((unsigned char)c) - 'a' + 10 : 99;
}

static const char *behind_sign(const char *text, int *negative)
{
	while (isspace((unsigned char)*text))
		text++;
	*negative = *text == '-';
	return text + (*text == '-' || *text == '+');
}

/* Returns the magnitude; one above `most` is clipped to it, and ERANGE told. */
static u64 whole(const char *text, char **end, int base, u64 most, u64 most_negative, int *negative)
{
	const char *at = behind_sign(text, negative);
	u64 value = 0, limit = *negative ? most_negative : most;
	int any = 0, large = 0;
	if ((base == 0 || base == 16) && at[0] == '0' && (at[1] | 32) == 'x' && digit_of(at[2]) < 16) {
		at += 2;
		base = 16;
	}
	if (base == 0)
		base = *at == '0' ? 8 : 10;
	for (; digit_of(*at) < base; at++, any = 1) {
		u64 digit = (u64)digit_of(*at);
		large |= value > (limit - digit) / (u64)base || digit > limit;
		value = value * (u64)base + digit;
	}
	if (end)
		*end = (char *)(any ? at : text);
	if (!large)
		return value;
	errno = ERANGE;
	return limit;
}

long long strtoll(const char *text, char **end, int base)
{
	int negative;
	u64 value = whole(text, end, base, LLONG_MAX, 1ULL << 63, &negative);
	return (long long)(negative ? 0 - value : value);
}

long strtol(const char *text, char **end, int base)
{
	int negative;
	u64 value = whole(text, end, base, LONG_MAX, 1ULL << 31, &negative);
	return (long)(negative ? 0 - value : value);
}

unsigned long long strtoull(const char *text, char **end, int base)
{
	int negative;
	u64 value = whole(text, end, base, ULLONG_MAX, ULLONG_MAX, &negative);
	return negative && value != ULLONG_MAX ? 0 - value : value;
}

unsigned long strtoul(const char *text, char **end, int base)
{
	int negative;
	u64 value = whole(text, end, base, ULONG_MAX, ULONG_MAX, &negative);
	return (unsigned long)(negative && value != ULONG_MAX ? 0 - value : value);
}

int atoi(const char *text) { return (int)strtol(text, 0, 10); }
long atol(const char *text) { return strtol(text, 0, 10); }
long long atoll(const char *text) { return strtoll(text, 0, 10); }

/* Reads the exponent behind a mantissa; without digits there is none. */
static const char *read_exponent(const char *at, char mark, int *exponent)
{
	int negative, value = 0;
	*exponent = 0;
	if ((*at | 32) != mark)
		return at;
	const char *digits = at + 1;
	negative = *digits == '-';
	digits += *digits == '-' || *digits == '+';
	if (!isdigit((unsigned char)*digits))
		return at;
	for (; isdigit((unsigned char)*digits); digits++)
		if (value < 100000)
			value = 10 * value + *digits - '0';
	*exponent = negative ? -value : value;
	return digits;
}

static void append(struct decimal *number, int digit, int behind)
{
	if (number->length == 0 && digit == 0) {
		number->point -= behind;
		return;
	}
	if (number->length < DIGITS)
		number->digits[number->length++] = (char)digit;
	else if (digit) /* what is cut off only has to be there */
		number->digits[DIGITS - 1] |= 1;
	number->point += !behind;
}

/* Reads 123.45e6; returns the end, which is `at` where there is no number. */
static const char *read_decimal(const char *at, struct decimal *number)
{
	int any = 0, behind = 0, exponent;
	const char *start = at;
	number->length = number->point = 0;
	for (;; at++) {
		if (isdigit((unsigned char)*at)) {
			append(number, *at - '0', behind);
			any = 1;
		} else if (*at == '.' && !behind) {
			behind = 1;
		} else {
			break;
		}
	}
	if (!any)
		return start;
	at = read_exponent(at, 'e', &exponent);
	number->point += exponent;
	while (number->length && !number->digits[number->length - 1])
		number->length--;
	return at;
}

/* Reads 0x1.8p3 behind the 0x. */
static const char *read_hexadecimal(const char *at, struct decimal *number)
{
	u64 mantissa = 0;
	int shift = 0, behind = 0, any = 0, exponent;
	const char *start = at;
	for (;; at++) {
		if (digit_of(*at) < 16) {
			int room = mantissa >> 58 == 0;
			mantissa = room ? mantissa << 4 | (u64)digit_of(*at) : mantissa | !!digit_of(*at);
			shift += 4 * (!room - behind);
			any = 1;
		} else if (*at == '.' && !behind) {
			behind = 1;
		} else {
			break;
		}
	}
	if (!any)
		return start;
	at = read_exponent(at, 'p', &exponent);
	exponent += shift;
	if (exponent < -1200) { /* all of it is below the smallest number */
		exponent = -1200;
		mantissa = !!mantissa;
	} else if (exponent > 1100) {
		exponent = 1100;
	}
	decimal_of(mantissa, exponent, number);
	return at;
}

static int has_word(const char *at, const char *word)
{
	return !strncasecmp(at, word, strlen(word));
}

/* Reads a number of any form. Returns 'd' with `number`, 'i' for infinity, 'n' for NaN. */
static char read_number(const char *text, char **end, int *negative, struct decimal *number)
{
	const char *at = behind_sign(text, negative), *behind;
	char kind = 'd';
	number->length = 0;
	if (has_word(at, "inf")) {
		kind = 'i';
		behind = at + (has_word(at, "infinity") ? 8 : 3);
	} else if (has_word(at, "nan")) {
		kind = 'n';
		behind = at + 3;
	} else if (at[0] == '0' && (at[1] | 32) == 'x' && (digit_of(at[2]) < 16 || (at[2] == '.' && digit_of(at[3]) < 16))) {
		behind = read_hexadecimal(at + 2, number);
	} else {
		behind = read_decimal(at, number);
	}
	if (end)
		*end = (char *)(behind == at ? text : behind);
	return kind;
}

double strtod(const char *text, char **end)
{
	struct decimal number;
	int negative;
	char kind = read_number(text, end, &negative, &number);
	double value = kind == 'i' ? INFINITY : kind == 'n' ? NAN : decimal_to_double(&number);
	if (kind == 'd' && (isinf(value) || (number.length && fabs(value) < 0x1p-1022)))
		errno = ERANGE;
	return negative ? -value : value;
}

float strtof(const char *text, char **end)
{
	struct decimal number;
	int negative;
	char kind = read_number(text, end, &negative, &number);
	float value = kind == 'i' ? INFINITY : kind == 'n' ? NAN : decimal_to_float(&number);
	if (kind == 'd' && (isinf(value) || (number.length && fabsf(value) < 0x1p-126f)))
		errno = ERANGE;
	return negative ? -value : value;
}

long double strtold(const char *text, char **end) { return strtod(text, end); }
double atof(const char *text) { return strtod(text, 0); }

intmax_t strtoimax(const char *text, char **end, int base) { return strtoll(text, end, base); }
uintmax_t strtoumax(const char *text, char **end, int base) { return strtoull(text, end, base); }
intmax_t imaxabs(intmax_t number) { return llabs(number); }

imaxdiv_t imaxdiv(intmax_t number, intmax_t by)
{
	return (imaxdiv_t){number / by, number % by};
}
