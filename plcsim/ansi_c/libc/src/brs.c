/* Strings and numbers as texts: what the controller's libraries AsBrStr, asstring and AsBrWStr add
 * to those of C. The headers of the libraries declare them. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef unsigned short character; /* of a WSTRING */

enum { TO_WIDE, TO_NARROW }; /* brwU8toUC, brwUCtoU8 */

/* Copies a string; returns the address of the terminator. */
char *brsstrcpy(char *target, const char *source) { return stpcpy(target, source); }

/* Appends a string; returns the address of the terminator. */
char *brsstrcat(char *target, const char *source)
{
	return stpcpy(target + strlen(target), source);
}

/* Returns the length as a UINT. */
unsigned short plc_strlen(const char *text) { return (unsigned short)strlen(text); }

/* Writes decimal digits; returns how many characters. */
unsigned short brsitoa(int value, char *target) { return (unsigned short)sprintf(target, "%d", value); }

/* Writes at most seven digits that count, in the shorter of both forms; returns how many
 * characters. */
unsigned short brsftoa(float value, char *target)
{
	return (unsigned short)sprintf(target, "%.7g", (double)value);
}

float brsatof(const char *text) { return strtof(text, 0); }
double brsatod(const char *text) { return strtod(text, 0); }

size_t brwcslen(const character *text)
{
	const character *end = text;
	while (*end)
		end++;
	return (size_t)(end - text);
}

/* Copies at most `most` characters and terminates behind them. */
static character *copied(character *target, const character *source, size_t most)
{
	while (most-- && *source)
		*target++ = *source++;
	*target = 0;
	return target;
}

character *brwcscpy(character *target, const character *source)
{
	copied(target, source, (size_t)-1);
	return target;
}

character *brwcscat(character *target, const character *source)
{
	copied(target + brwcslen(target), source, (size_t)-1);
	return target;
}

/* As strncpy does: what is short is filled up with zeros, what is long is not terminated. */
character *brwcsncpy(character *target, const character *source, size_t count)
{
	for (size_t index = 0; index < count; index++)
		target[index] = *source ? *source++ : 0;
	return target;
}

character *brwcsncat(character *target, const character *source, size_t most)
{
	copied(target + brwcslen(target), source, most);
	return target;
}

int brwcsncmp(const character *a, const character *b, size_t most)
{
	while (most && *a && *a == *b)
		a++, b++, most--;
	return most ? (*a > *b) - (*a < *b) : 0;
}

int brwcscmp(const character *a, const character *b) { return brwcsncmp(a, b, (size_t)-1); }

character *brwcschr(const character *text, character wanted)
{
	while (*text && *text != wanted)
		text++;
	return *text == wanted ? (character *)text : 0;
}

character *brwcsrchr(const character *text, character wanted)
{
	const character *at = text + brwcslen(text);
	while (at != text && *at != wanted)
		at--;
	return *at == wanted ? (character *)at : 0;
}

character *brwcsset(character *target, size_t count, character value)
{
	for (size_t index = 0; index < count; index++)
		target[index] = value;
	return target;
}

/* Converts between STRING and WSTRING; a character that a STRING cannot hold becomes `?`. Returns
 * the address of the target. */
void *brwcsconv(void *target, const void *source, unsigned char level)
{
	if (level == TO_WIDE) {
		const unsigned char *from = source;
		character *to = target;
		while ((*to++ = *from++))
			;
	} else {
		const character *from = source;
		unsigned char *to = target;
		do
			*to++ = *from < 0x100 ? (unsigned char)*from : '?';
		while (*from++);
	}
	return target;
}
