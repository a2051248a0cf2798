/* Strings that end with a zero byte. */

#include <ctype.h>
#include <string.h>

typedef unsigned char byte;

size_t strlen(const char *text)
{
	const char *end = text;
	while (*end)
		end++;
	return (size_t)(end - text);
}

size_t strnlen(const char *text, size_t most)
{
	size_t length = 0;
	while (length < most && text[length])
		length++;
	return length;
}

char *stpcpy(char *target, const char *source)
{
	while ((*target = *source++))
		target++;
	return target;
}

char *strcpy(char *target, const char *source)
{
	stpcpy(target, source);
	return target;
}

char *strncpy(char *target, const char *source, size_t count)
{
	size_t length = strnlen(source, count);
	memcpy(target, source, length);
	memset(target + length, 0, count - length);
	return target;
}

char *strcat(char *target, const char *source)
{
	stpcpy(target + strlen(target), source);
	return target;
}

char *strncat(char *target, const char *source, size_t most)
{
	char *end = target + strlen(target);
	size_t length = strnlen(source, most);
	memcpy(end, source, length);
	end[length] = 0;
	return target;
}

int strcmp(const char *a, const char *b)
{
	while (*a && *a == *b)
		a++, b++;
	return (byte)*a - (byte)*b;
}

int strncmp(const char *a, const char *b, size_t most)
{
	for (; most; most--, a++, b++)
		if (*a != *b || !*a)
			return (byte)*a - (byte)*b;
	return 0;
}

int strcoll(const char *a, const char *b)
{
	return strcmp(a, b);
}

int strncasecmp(const char *a, const char *b, size_t most)
{
	for (; most; most--, a++, b++) {
		int difference = tolower((byte)*a) - tolower((byte)*b);
		if (difference || !*a)
			return difference;
	}
	return 0;
}

int strcasecmp(const char *a, const char *b)
{
	return strncasecmp(a, b, (size_t)-1);
}

char *strchr(const char *text, int character)
{
	for (; *text != (char)character; text++)
		if (!*text)
			return 0;
	return (char *)text;
}

char *strrchr(const char *text, int character)
{
	const char *found = 0;
	do
		if (*text == (char)character)
			found = text;
	while (*text++);
	return (char *)found;
}

char *strstr(const char *text, const char *part)
{
	size_t length = strlen(part);
	for (; strncmp(text, part, length); text++)
		if (!*text)
			return 0;
	return (char *)text;
}

size_t strcspn(const char *text, const char *rejected)
{
	size_t length = 0;
	while (text[length] && !strchr(rejected, text[length]))
		length++;
	return length;
}

size_t strspn(const char *text, const char *accepted)
{
	size_t length = 0;
	while (text[length] && strchr(accepted, text[length]))
		length++;
	return length;
}

char *strpbrk(const char *text, const char *any)
{
	text += strcspn(text, any);
	return *text ? (char *)text : 0;
}

char *strtok_r(char *text, const char *separators, char **rest)
{
	if (!text)
		text = *rest;
	if (!text)
		return 0;
	text += strspn(text, separators);
	if (!*text) {
		*rest = 0;
		return 0;
	}
	char *end = text + strcspn(text, separators);
	*rest = *end ? end + 1 : 0;
	*end = 0;
	return text;
}

char *strtok(char *text, const char *separators)
{
	static char *rest;
	return strtok_r(text, separators, &rest);
}

size_t strlcpy(char *target, const char *source, size_t size)
{
	size_t length = strlen(source), part = length < size ? length : size - 1;
	if (size) {
		memcpy(target, source, part);
		target[part] = 0;
	}
	return length;
}

size_t strlcat(char *target, const char *source, size_t size)
{
	size_t used = strnlen(target, size);
	return used + strlcpy(target + used, source, size - used);
}

size_t strxfrm(char *target, const char *source, size_t count)
{
	return strlcpy(target, source, count);
}

char *strsep(char **rest, const char *separators)
{
	char *text = *rest;
	if (!text)
		return 0;
	char *end = text + strcspn(text, separators);
	*rest = *end ? end + 1 : 0;
	*end = 0;
	return text;
}

char *strcasestr(const char *text, const char *part)
{
	size_t length = strlen(part);
	for (; strncasecmp(text, part, length); text++)
		if (!*text)
			return 0;
	return (char *)text;
}

char *stpncpy(char *target, const char *source, size_t count)
{
	strncpy(target, source, count);
	return target + strnlen(source, count);
}

char *strchrnul(const char *text, int character)
{
	char *found = strchr(text, character);
	return found ? found : (char *)text + strlen(text);
}

void *rawmemchr(const void *area, int value) { return memchr(area, value, (size_t)-1 >> 1); }

char *strlwr(char *text)
{
	for (char *next = text; *next; next++)
		*next = (char)tolower((unsigned char)*next);
	return text;
}

char *strupr(char *text)
{
	for (char *next = text; *next; next++)
		*next = (char)toupper((unsigned char)*next);
	return text;
}
