/* Formatted input, from texts. */

#include <ctype.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LONGEST 400 /* characters of a number */

struct item {
	int keep; /* whether there is a place for it */
	size_t width;
	char length; /* h, H for hh, l, L for ll and j, 0 */
};

static const char *read_item(const char *format, struct item *item)
{
	item->keep = *format != '*';
	format += !item->keep;
	item->width = 0;
	for (; isdigit((unsigned char)*format); format++)
		item->width = item->width < 100000000 ? 10 * item->width + (size_t)(*format - '0') : item->width;
	item->length = 0;
	switch (*format) {
	case 'h':
		item->length = format[1] == 'h' ? 'H' : 'h';
		return format + (format[1] == 'h' ? 2 : 1);
	case 'l':
		item->length = format[1] == 'l' ? 'L' : 'l';
		return format + (format[1] == 'l' ? 2 : 1);
	case 'j':
	case 'L':
		item->length = 'L';
		return format + 1;
	case 'z':
	case 't':
		return format + 1;
	default:
		return format;
	}
}

static void store(const struct item *item, void *at, unsigned long long value)
{
	if (item->length == 'H')
		*(unsigned char *)at = (unsigned char)value;
	else if (item->length == 'h')
		*(unsigned short *)at = (unsigned short)value;
	else if (item->length == 'L')
		*(unsigned long long *)at = value;
	else
		*(unsigned *)at = (unsigned)value;
}

/* Copies at most the width of an item to where strto... find nothing else behind it. */
static const char *part_of(const char *text, const struct item *item, char *part)
{
	size_t most = item->width && item->width < LONGEST ? item->width : LONGEST;
	size_t length = strnlen(text, most);
	memcpy(part, text, length);
	part[length] = 0;
	return part;
}

static const char *scan_integer(const char *text, const struct item *item, int base, int is_signed, void *at)
{
	char part[LONGEST + 1], *end;
	unsigned long long value;
	part_of(text, item, part);
	value = is_signed ? (unsigned long long)strtoll(part, &end, base) : strtoull(part, &end, base);
	if (end == part)
		return 0;
	if (at)
		store(item, at, value);
	return text + (end - part);
}

static const char *scan_float(const char *text, const struct item *item, void *at)
{
	char part[LONGEST + 1], *end;
	part_of(text, item, part);
	double value = strtod(part, &end);
	if (end == part)
		return 0;
	if (at && item->length == 'l')
		*(double *)at = value;
	else if (at && item->length == 'L')
		*(long double *)at = value;
	else if (at)
		*(float *)at = strtof(part, 0);
	return text + (end - part);
}

/* Whether a character is in a set such as ^a-z], which is behind its bracket. */
static int is_in(const char *set, char character)
{
	int inverse = *set == '^', found = 0;
	const char *first = set + inverse;
	for (const char *at = first; *at && (at == first || *at != ']'); at++) {
		if (at[1] == '-' && at[2] && at[2] != ']') {
			found |= (unsigned char)character >= (unsigned char)at[0]
			         && (unsigned char)character <= (unsigned char)at[2];
			at += 2;
		} else {
			found |= *at == character;
		}
	}
	return found != inverse;
}

static const char *behind_set(const char *set)
{
	set += *set == '^';
	const char *end = *set ? strchr(set + 1, ']') : 0;
	return end ? end + 1 : set + strlen(set);
}

static const char *scan_text(const char *text, const struct item *item, char kind, const char *set, char *at)
{
	size_t most = item->width ? item->width : kind == 'c' ? 1 : SIZE_MAX, length = 0;
	while (length < most && text[length]
	       && (kind == 'c' || (kind == 's' ? !isspace((unsigned char)text[length]) : is_in(set, text[length]))))
		length++;
	if (!length || (kind == 'c' && length < most))
		return 0;
	if (at) {
		memcpy(at, text, length);
		if (kind != 'c')
			at[length] = 0;
	}
	return text + length;
}

static const char *behind_spaces(const char *text)
{
	while (isspace((unsigned char)*text))
		text++;
	return text;
}

/* Reads one item; returns the text behind it, 0 where it is not there. */
static const char *scan(const char *text, const struct item *item, const char *kind, void *at)
{
	switch (*kind) {
	case 'd':
		return scan_integer(text, item, 10, 1, at);
	case 'i':
		return scan_integer(text, item, 0, 1, at);
	case 'u':
		return scan_integer(text, item, 10, 0, at);
	case 'o':
		return scan_integer(text, item, 8, 0, at);
	case 'x':
	case 'X':
	case 'p':
		return scan_integer(text, item, 16, 0, at);
	case 'c':
	case 's':
	case '[':
		return scan_text(text, item, *kind, kind + 1, at);
	case 'a':
	case 'A':
	case 'e':
	case 'E':
	case 'f':
	case 'F':
	case 'g':
	case 'G':
		return scan_float(text, item, at);
	default:
		return 0;
	}
}

int plc_scan(const char *text, const char *format, va_list given, size_t *length);

/* As vsscanf, and tells how many characters it has taken. */
int plc_scan(const char *text, const char *format, va_list given, size_t *length)
{
	const char *start = text;
	int count = 0, read = 0;
	va_list targets;
	va_copy(targets, given);
	while (*format) {
		struct item item;
		if (isspace((unsigned char)*format)) {
			text = behind_spaces(text);
			format++;
			continue;
		}
		if (*format != '%' || format[1] == '%') {
			if (*format == '%')
				text = behind_spaces(text), format++;
			if (*text != *format)
				break;
			text++, format++;
			continue;
		}
		format = read_item(format + 1, &item);
		if (*format == 'n') {
			if (item.keep)
				store(&item, va_arg(targets, void *), (unsigned long long)(text - start));
			format++;
			continue;
		}
		if (*format != 'c' && *format != '[')
			text = behind_spaces(text);
		if (!*text) {
			count = read ? count : EOF;
			break;
		}
		void *at = item.keep ? va_arg(targets, void *) : 0;
		const char *behind = scan(text, &item, format, at);
		if (!behind)
			break;
		text = behind;
		read = 1;
		count += item.keep;
		format = *format == '[' ? behind_set(format + 1) : format + 1;
	}
	va_end(targets);
	*length = (size_t)(text - start);
	return count;
}

int vsscanf(const char *text, const char *format, va_list targets)
{
	size_t length;
	return plc_scan(text, format, targets, &length);
}

int sscanf(const char *text, const char *format, ...)
{
	va_list targets;
	va_start(targets, format);
	int count = vsscanf(text, format, targets);
	va_end(targets);
	return count;
}
