/* Wide characters, and UTF-8. */

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <wchar.h>

size_t wcslen(const wchar_t *text)
{
	const wchar_t *end = text;
	while (*end)
		end++;
	return (size_t)(end - text);
}

wchar_t *wmemcpy(wchar_t *target, const wchar_t *source, size_t count)
{
	return memcpy(target, source, count * sizeof *target);
}

wchar_t *wmemmove(wchar_t *target, const wchar_t *source, size_t count)
{
	return memmove(target, source, count * sizeof *target);
}

wchar_t *wmemset(wchar_t *target, wchar_t value, size_t count)
{
	for (size_t i = 0; i < count; i++)
		target[i] = value;
	return target;
}

int wmemcmp(const wchar_t *a, const wchar_t *b, size_t count)
{
	for (; count; count--, a++, b++)
		if (*a != *b)
			return *a < *b ? -1 : 1;
	return 0;
}

wchar_t *wmemchr(const wchar_t *area, wchar_t value, size_t count)
{
	for (; count; count--, area++)
		if (*area == value)
			return (wchar_t *)area;
	return 0;
}

wchar_t *wcscpy(wchar_t *target, const wchar_t *source)
{
	return wmemcpy(target, source, wcslen(source) + 1);
}

wchar_t *wcsncpy(wchar_t *target, const wchar_t *source, size_t count)
{
	size_t length = 0;
	for (; length < count && source[length]; length++)
		target[length] = source[length];
	wmemset(target + length, 0, count - length);
	return target;
}

wchar_t *wcscat(wchar_t *target, const wchar_t *source)
{
	wcscpy(target + wcslen(target), source);
	return target;
}

int wcsncmp(const wchar_t *a, const wchar_t *b, size_t most)
{
	for (; most; most--, a++, b++)
		if (*a != *b || !*a)
			return (*a > *b) - (*a < *b);
	return 0;
}

int wcscmp(const wchar_t *a, const wchar_t *b) { return wcsncmp(a, b, (size_t)-1); }

wchar_t *wcschr(const wchar_t *text, wchar_t character)
{
	return wmemchr(text, character, wcslen(text) + 1);
}

wchar_t *wcsrchr(const wchar_t *text, wchar_t character)
{
	for (size_t i = wcslen(text) + 1; i--;)
		if (text[i] == character)
			return (wchar_t *)text + i;
	return 0;
}

wchar_t *wcsstr(const wchar_t *text, const wchar_t *part)
{
	size_t length = wcslen(part);
	for (; wcsncmp(text, part, length); text++)
		if (!*text)
			return 0;
	return (wchar_t *)text;
}

static int wrong(void)
{
	errno = EILSEQ;
	return -1;
}

/* UTF-8 (RFC 3629). */
int mbtowc(wchar_t *character, const char *text, size_t size)
{
	static const unsigned least[] = {0, 0x80, 0x800, 0x10000};
	if (!text)
		return 0;
	if (!size)
		return wrong();
	unsigned first = (unsigned char)*text;
	int more = first < 0x80 ? 0 : first < 0xc0 ? -1 : first < 0xe0 ? 1 : first < 0xf0 ? 2 : first < 0xf8 ? 3 : -1;
	if (more < 0 || (size_t)more >= size)
		return wrong();
	unsigned value = more ? first & (0x3fu >> more) : first;
	for (int i = 1; i <= more; i++) {
		if (((unsigned char)text[i] & 0xc0) != 0x80)
			return wrong();
		value = value << 6 | ((unsigned char)text[i] & 0x3f);
	}
	if (value < least[more] || value > 0x10ffff || (value >= 0xd800 && value < 0xe000))
		return wrong();
	if (character)
		*character = (wchar_t)value;
	return value ? more + 1 : 0;
}

int mblen(const char *text, size_t size) { return mbtowc(0, text, size); }

int wctomb(char *text, wchar_t character)
{
	unsigned value = (unsigned)character;
	if (!text)
		return 0;
	if (value > 0x10ffff || (value >= 0xd800 && value < 0xe000))
		return wrong();
	int more = value < 0x80 ? 0 : value < 0x800 ? 1 : value < 0x10000 ? 2 : 3;
	static const unsigned char marks[] = {0, 0xc0, 0xe0, 0xf0};
	for (int i = more; i > 0; i--, value >>= 6)
		text[i] = (char)(0x80 | (value & 0x3f));
	text[0] = (char)(marks[more] | value);
	return more + 1;
}

size_t mbstowcs(wchar_t *target, const char *source, size_t count)
{
	size_t done = 0;
	for (; !target || done < count; done++) {
		wchar_t character;
		int length = mbtowc(&character, source, 4);
		if (length < 0)
			return (size_t)-1;
		if (target)
			target[done] = length ? character : 0;
		if (!length)
			return done;
		source += length;
	}
	return done;
}

size_t wcstombs(char *target, const wchar_t *source, size_t size)
{
	size_t done = 0;
	for (; *source; source++) {
		char part[4];
		int length = wctomb(part, *source);
		if (length < 0)
			return (size_t)-1;
		if (target && done + (size_t)length > size)
			return done;
		if (target)
			memcpy(target + done, part, (size_t)length);
		done += (size_t)length;
	}
	if (target && done < size)
		target[done] = 0;
	return done;
}
