/* The string functions of IEC 61131-3 (2.5.1.5.5), as the controller's library standard has them:
 * positions count from 1, a result has at most 255 characters. A result is written to the address
 * that comes first. What the norm calls an error (a position or a length that is not there) takes
 * the part of the string that is there. */

#include <string.h>

#define MOST 255

/* Appends at most `count` characters of a text to a result. */
static int append(char *target, int length, const char *text, int count)
{
	for (; count > 0 && *text && length < MOST; count--)
		target[length++] = *text++;
	target[length] = 0;
	return length;
}

static int limited(int value, int most) { return value < 0 ? 0 : value > most ? most : value; }

short iec_len(const char *text) { return (short)strnlen(text, 32767); }

void iec_left(char *target, const char *text, short count) { append(target, 0, text, count); }

void iec_right(char *target, const char *text, short count)
{
	int length = (int)strlen(text);
	append(target, 0, text + length - limited(count, length), MOST);
}

void iec_mid(char *target, const char *text, short count, short position)
{
	int length = (int)strlen(text);
	*target = 0;
	if (position > 0)
		append(target, 0, text + limited(position - 1, length), count);
}

void iec_concat(char *target, const char *a, const char *b)
{
	append(target, append(target, 0, a, MOST), b, MOST);
}

void iec_insert(char *target, const char *text, const char *inserted, short position)
{
	int place = limited(position, (int)strlen(text));
	int length = append(target, 0, text, place);
	append(target, append(target, length, inserted, MOST), text + place, MOST);
}

void iec_replace(char *target, const char *text, const char *other, short count, short position)
{
	int size = (int)strlen(text);
	int place = limited(position - 1, size);
	int rest = place + limited(count, size - place);
	int length = append(target, 0, text, place);
	append(target, append(target, length, other, MOST), text + rest, MOST);
}

void iec_delete(char *target, const char *text, short count, short position)
{
	if (position > 0)
		iec_replace(target, text, "", count, position);
	else
		append(target, 0, text, MOST);
}

short iec_find(const char *text, const char *part)
{
	const char *found = *part ? strstr(text, part) : 0;
	return found ? (short)(found - text + 1) : 0;
}
