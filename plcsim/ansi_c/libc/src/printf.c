/* Formatted output: into texts, and to the scan's standard output. Numbers are written exactly and
 * rounded once, ties to even. */

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "decimal.h"
#include "host.h"

typedef unsigned long long u64;

/* Where a text goes: an area, or a file by way of a small area. */
struct target {
	char *area;
	size_t size; /* of the area, without the terminating zero */
	size_t used; /* bytes in the area */
	size_t count; /* bytes written at all */
	FILE *file; /* NULL for none */
};

static void flush(struct target *to)
{
	if (to->used)
		fwrite(to->area, 1, to->used, to->file);
	to->used = 0;
}

static void put(struct target *to, const char *text, size_t length)
{
	to->count += length;
	while (length) {
		size_t room = to->size - to->used;
		size_t part = length < room ? length : room;
		memcpy(to->area + to->used, text, part);
		to->used += part;
		text += part;
		length -= part;
		if (!length || !to->file)
			return;
		flush(to);
	}
}

static void put_many(struct target *to, char character, int count)
{
	char some[16];
	memset(some, character, sizeof some);
	for (; count > 0; count -= (int)sizeof some)
		put(to, some, (size_t)(count < (int)sizeof some ? count : (int)sizeof some));
}

struct format {
	int left, plus, space, alternative, zero;
	int width;
	int precision; /* -1 for none */
	char length; /* h, H for hh, l, L for ll, q for long double, 0 */
};

/* A field is a prefix and `length` bytes, filled to its width: with spaces on one side, or with zeros
 * between the two. What is in it is put between the two calls. */

static void begin_field(struct target *to, const struct format *f, const char *prefix, int length)
{
	int before = (int)strlen(prefix), fill = f->width - before - length;
	if (!f->left && !f->zero)
		put_many(to, ' ', fill);
	put(to, prefix, (size_t)before);
	if (!f->left && f->zero)
		put_many(to, '0', fill);
}

static void end_field(struct target *to, const struct format *f, const char *prefix, int length)
{
	if (f->left)
		put_many(to, ' ', f->width - (int)strlen(prefix) - length);
}

static void put_field(
	struct target *to, const struct format *f, const char *prefix, const char *text, int length)
{
	begin_field(to, f, prefix, length);
	put(to, text, (size_t)length);
	end_field(to, f, prefix, length);
}

static const char *sign_of(const struct format *f, int negative)
{
	return negative ? "-" : f->plus ? "+" : f->space ? " " : "";
}

/* Integers */

static void put_integer(
	struct target *to, struct format f, const char *prefix, u64 value, unsigned base, int capital)
{
	char digits[22]; /* 64 bits, octal */
	const char *figures = capital ? "0123456789ABCDEF" : "0123456789abcdef";
	int at = sizeof digits;
	for (; value; value /= base)
		digits[--at] = figures[value % base];
	int length = (int)sizeof digits - at;
	if (f.precision < 0)
		f.precision = 1;
	else
		f.zero = 0;
	if (base == 8 && f.alternative && f.precision <= length)
		f.precision = length + 1;
	int zeros = f.precision > length ? f.precision - length : 0;
	begin_field(to, &f, prefix, zeros + length);
	put_many(to, '0', zeros);
	put(to, digits + at, (size_t)length);
	end_field(to, &f, prefix, zeros + length);
}

/* Floating-point numbers */

/* Puts digits of a number, with the zeros before and behind those that it has. */
static void put_digits(struct target *to, const struct decimal *number, int from, int end)
{
	for (; from < end && from < 0; from++)
		put(to, "0", 1);
	for (; from < end && from < number->length; from++) {
		char digit = (char)('0' + number->digits[from]);
		put(to, &digit, 1);
	}
	put_many(to, '0', end - from);
}

/* Puts the digits from `first` on, `whole` being the first of `behind` ones behind the point. */
static void put_number(
	struct target *to, const struct format *f, const char *sign, const struct decimal *number,
	int first, int whole, int behind, const char *exponent)
{
	int point = behind > 0 || f->alternative;
	int length = whole - first + point + behind + (int)strlen(exponent);
	begin_field(to, f, sign, length);
	put_digits(to, number, first, whole);
	put(to, ".", (size_t)point);
	put_digits(to, number, whole, whole + behind);
	put(to, exponent, strlen(exponent));
	end_field(to, f, sign, length);
}

static void write_exponent(char *to, char mark, int exponent)
{
	*to++ = mark;
	*to++ = exponent < 0 ? '-' : '+';
	exponent = exponent < 0 ? -exponent : exponent;
	if (exponent >= 100)
		*to++ = (char)('0' + exponent / 100);
	*to++ = (char)('0' + exponent / 10 % 10);
	*to++ = (char)('0' + exponent % 10);
	*to = 0;
}

/* 123.456 */
static void put_fixed(
	struct target *to, const struct format *f, const char *sign, const struct decimal *number, int behind)
{
	int whole = number->point;
	put_number(to, f, sign, number, whole > 0 ? 0 : whole - 1, whole, behind, "");
}

/* 1.23456e+02 */
static void put_scientific(
	struct target *to, const struct format *f, const char *sign, const struct decimal *number,
	int behind, char mark)
{
	char exponent[8];
	write_exponent(exponent, mark, number->length ? number->point - 1 : 0);
	put_number(to, f, sign, number, 0, 1, behind, exponent);
}

static void put_general(
	struct target *to, const struct format *f, const char *sign, struct decimal *number, char mark)
{
	int precision = f->precision < 0 ? 6 : f->precision ? f->precision : 1;
	decimal_round(number, precision);
	int exponent = number->length ? number->point - 1 : 0;
	int fixed = exponent >= -4 && exponent < precision;
	int behind = precision - 1 - (fixed ? exponent : 0);
	if (!f->alternative) { /* no zeros at the end */
		int needed = number->length - (fixed ? number->point : 1);
		behind = needed < 0 || !number->length ? 0 : needed < behind ? needed : behind;
	}
	if (fixed)
		put_fixed(to, f, sign, number, behind);
	else
		put_scientific(to, f, sign, number, behind, mark);
}

/* Rounds to hexadecimal digits behind the point, ties to even. */
static u64 rounded_mantissa(u64 mantissa, int digits)
{
	if (digits < 0 || digits >= 13)
		return mantissa;
	u64 unit = 1ULL << (4 * (13 - digits)), rest = mantissa & (unit - 1);
	mantissa -= rest;
	return rest > unit / 2 || (rest == unit / 2 && mantissa & unit) ? mantissa + unit : mantissa;
}

static void write_binary_exponent(char *to, char mark, int exponent)
{
	*to++ = mark;
	*to++ = exponent < 0 ? '-' : '+';
	exponent = exponent < 0 ? -exponent : exponent;
	int unit = exponent >= 1000 ? 1000 : exponent >= 100 ? 100 : exponent >= 10 ? 10 : 1;
	for (; unit; unit /= 10)
		*to++ = (char)('0' + exponent / unit % 10);
	*to = 0;
}

/* 0x1.8p+3 */
static void put_hexadecimal(
	struct target *to, const struct format *f, const char *sign, double value, int capital)
{
	union { double value; u64 bits; } as = {value};
	int biased = (int)(as.bits >> 52) & 0x7FF;
	u64 mantissa = (as.bits & 0xFFFFFFFFFFFFFULL) | (biased ? 1ULL << 52 : 0);
	mantissa = rounded_mantissa(mantissa, f->precision);
	char text[16], *at = text, prefix[4], exponent[8];
	const char *figures = capital ? "0123456789ABCDEF" : "0123456789abcdef";
	strcpy(prefix, sign);
	strcat(prefix, capital ? "0X" : "0x");
	write_binary_exponent(exponent, capital ? 'P' : 'p', !mantissa ? 0 : biased ? biased - 1023 : -1022);
	*at++ = figures[mantissa >> 52];
	mantissa = mantissa << 12;
	if (mantissa || f->precision > 0 || f->alternative)
		*at++ = '.';
	for (int i = 0; i < 13 && (f->precision < 0 ? mantissa != 0 : i < f->precision); i++, mantissa <<= 4)
		*at++ = figures[mantissa >> 60];
	int zeros = f->precision > 13 ? f->precision - 13 : 0;
	int length = (int)(at - text) + zeros + (int)strlen(exponent);
	begin_field(to, f, prefix, length);
	put(to, text, (size_t)(at - text));
	put_many(to, '0', zeros);
	put(to, exponent, strlen(exponent));
	end_field(to, f, prefix, length);
}

static void put_double(struct target *to, struct format f, double value, char kind)
{
	struct decimal number;
	int capital = kind < 'a', precision = f.precision < 0 ? 6 : f.precision;
	const char *sign = sign_of(&f, signbit(value));
	if (isnan(value) || isinf(value)) {
		f.zero = 0;
		put_field(to, &f, sign, isnan(value) ? capital ? "NAN" : "nan" : capital ? "INF" : "inf", 3);
		return;
	}
	if ((kind | 32) == 'a') {
		put_hexadecimal(to, &f, sign, value, capital);
		return;
	}
	decimal_of_double(value, &number);
	switch (kind | 32) {
	case 'f':
		decimal_round(&number, precision > 2 * DIGITS ? DIGITS : number.point + precision);
		put_fixed(to, &f, sign, &number, precision);
		break;
	case 'e':
		decimal_round(&number, precision > DIGITS ? DIGITS : 1 + precision);
		put_scientific(to, &f, sign, &number, precision, capital ? 'E' : 'e');
		break;
	default:
		put_general(to, &f, sign, &number, capital ? 'E' : 'e');
	}
}

/* The format */

static u64 unsigned_value(va_list *values, char length)
{
	switch (length) {
	case 'H': return (unsigned char)va_arg(*values, int);
	case 'h': return (unsigned short)va_arg(*values, int);
	case 'L': return va_arg(*values, u64);
	default: return va_arg(*values, unsigned);
	}
}

static long long signed_value(va_list *values, char length)
{
	switch (length) {
	case 'H': return (signed char)va_arg(*values, int);
	case 'h': return (short)va_arg(*values, int);
	case 'L': return va_arg(*values, long long);
	default: return va_arg(*values, int);
	}
}

static const char *read_flags(const char *at, struct format *f)
{
	for (;; at++) {
		if (*at == '-')
			f->left = 1;
		else if (*at == '+')
			f->plus = 1;
		else if (*at == ' ')
			f->space = 1;
		else if (*at == '#')
			f->alternative = 1;
		else if (*at == '0')
			f->zero = 1;
		else
			return at;
	}
}

static const char *read_count(const char *at, va_list *values, int *count)
{
	if (*at == '*') {
		*count = va_arg(*values, int);
		return at + 1;
	}
	for (*count = 0; *at >= '0' && *at <= '9'; at++)
		*count = *count < INT_MAX / 10 - 1 ? 10 * *count + *at - '0' : *count;
	return at;
}

static const char *read_length(const char *at, struct format *f)
{
	switch (*at) {
	case 'h':
		f->length = at[1] == 'h' ? 'H' : 'h';
		return at + (at[1] == 'h' ? 2 : 1);
	case 'l':
		f->length = at[1] == 'l' ? 'L' : 'l';
		return at + (at[1] == 'l' ? 2 : 1);
	case 'j':
		f->length = 'L';
		return at + 1;
	case 'L':
		f->length = 'q';
		return at + 1;
	case 'z':
	case 't':
		return at + 1;
	default:
		return at;
	}
}

static const char *read_format(const char *at, va_list *values, struct format *f)
{
	at = read_count(read_flags(at, f), values, &f->width);
	if (f->width < 0) {
		f->left = 1;
		f->width = -f->width;
	}
	f->precision = -1;
	if (*at == '.')
		at = read_count(at + 1, values, &f->precision);
	return read_length(at, f);
}

static void put_signed(struct target *to, const struct format *f, long long value)
{
	u64 magnitude = value < 0 ? 0 - (u64)value : (u64)value;
	put_integer(to, *f, sign_of(f, value < 0), magnitude, 10, 0);
}

static void put_text(struct target *to, struct format f, const char *text)
{
	if (!text)
		text = "(null)";
	f.zero = 0;
	size_t length = f.precision < 0 ? strlen(text) : strnlen(text, (size_t)f.precision);
	put_field(to, &f, "", text, (int)length);
}

/* What `%ls` and `%lc` say: bytes of UTF-8, no part of a character where the precision ends. */
static void put_wide(struct target *to, struct format f, const wchar_t *text)
{
	char bytes[4];
	size_t length = 0, most = f.precision < 0 ? (size_t)-1 : (size_t)f.precision;
	const wchar_t *end = text;
	for (int count; *end && (count = wctomb(bytes, *end)) > 0 && length + (size_t)count <= most; end++)
		length += (size_t)count;
	f.zero = 0;
	begin_field(to, &f, "", (int)length);
	for (; text < end; text++)
		put(to, bytes, (size_t)wctomb(bytes, *text));
	end_field(to, &f, "", (int)length);
}

static void put_character(struct target *to, struct format f, int character)
{
	wchar_t wide[2] = {character, 0};
	char narrow = (char)character;
	f.zero = 0;
	if (f.length == 'l')
		put_wide(to, f, wide);
	else
		put_field(to, &f, "", &narrow, 1);
}

static void put_string(struct target *to, const struct format *f, const void *text)
{
	if (f->length == 'l' && text)
		put_wide(to, *f, text);
	else
		put_text(to, *f, text);
}

static void store_count(const struct format *f, void *at, size_t count)
{
	if (f->length == 'H')
		*(signed char *)at = (signed char)count;
	else if (f->length == 'h')
		*(short *)at = (short)count;
	else if (f->length == 'L')
		*(long long *)at = (long long)count;
	else
		*(int *)at = (int)count;
}

static void put_value(struct target *to, struct format *f, char kind, va_list *values)
{
	u64 value;
	switch (kind) {
	case 'd':
	case 'i':
		put_signed(to, f, signed_value(values, f->length));
		break;
	case 'u':
		put_integer(to, *f, "", unsigned_value(values, f->length), 10, 0);
		break;
	case 'o':
		put_integer(to, *f, "", unsigned_value(values, f->length), 8, 0);
		break;
	case 'x':
	case 'X':
		value = unsigned_value(values, f->length);
		put_integer(to, *f, f->alternative && value ? kind == 'x' ? "0x" : "0X" : "", value, 16, kind == 'X');
		break;
	case 'p':
		put_integer(to, *f, "0x", (uintptr_t)va_arg(*values, void *), 16, 0);
		break;
	case 'c':
		put_character(to, *f, va_arg(*values, int));
		break;
	case 's':
		put_string(to, f, va_arg(*values, const void *));
		break;
	case 'n':
		store_count(f, va_arg(*values, void *), to->count);
		break;
	default:
		put_double(to, *f, f->length == 'q' ? (double)va_arg(*values, long double) : va_arg(*values, double), kind);
	}
}

static int put_format(struct target *to, const char *format, va_list given)
{
	va_list values;
	va_copy(values, given);
	for (;;) {
		const char *mark = strchr(format, '%');
		put(to, format, mark ? (size_t)(mark - format) : strlen(format));
		if (!mark)
			break;
		struct format f = {0};
		const char *kind = read_format(mark + 1, &values, &f);
		if (*kind == '%') {
			put(to, "%", 1);
		} else if (!*kind || !strchr("diuoxXpcsneEfFgGaA", *kind)) { /* as it stands */
			put(to, mark, (size_t)(kind - mark));
			format = kind;
			continue;
		} else {
			put_value(to, &f, *kind, &values);
		}
		format = kind + 1;
	}
	va_end(values);
	return to->count > INT_MAX ? -1 : (int)to->count;
}

int vsnprintf(char *text, size_t size, const char *format, va_list values)
{
	struct target to = {text, size ? size - 1 : 0, 0, 0, 0};
	int count = put_format(&to, format, values);
	if (size)
		text[to.used] = 0;
	return count;
}

int vsprintf(char *text, const char *format, va_list values)
{
	return vsnprintf(text, (size_t)0x80000000, format, values);
}

int vfprintf(FILE *file, const char *format, va_list values)
{
	char area[BUFSIZ];
	struct target to = {area, sizeof area, 0, 0, file};
	int count = put_format(&to, format, values);
	flush(&to);
	return count;
}

int vprintf(const char *format, va_list values) { return vfprintf(stdout, format, values); }

#define WITH_VALUES(call) \
	va_list values; \
	va_start(values, format); \
	int count = call; \
	va_end(values); \
	return count

int printf(const char *format, ...) { WITH_VALUES(vfprintf(stdout, format, values)); }
int fprintf(FILE *file, const char *format, ...) { WITH_VALUES(vfprintf(file, format, values)); }
int sprintf(char *text, const char *format, ...) { WITH_VALUES(vsprintf(text, format, values)); }

int snprintf(char *text, size_t size, const char *format, ...)
{
	WITH_VALUES(vsnprintf(text, size, format, values));
}
