/* Texts of any length, on the heap of who asks for them. */

#include <errno.h>

#include "heap.h"

int plc_vasprintf(struct plc_heap *heap, char **text, const char *format, va_list values)
{
	va_list again;
	va_copy(again, values);
	int length = vsnprintf(0, 0, format, again);
	va_end(again);
	*text = length < 0 ? 0 : plc_malloc(heap, (size_t)length + 1);
	return *text ? vsnprintf(*text, (size_t)length + 1, format, values) : -1;
}

long plc_getdelim(struct plc_heap *heap, char **text, size_t *size, int last, FILE *file)
{
	size_t length = 0;
	for (int c; (c = fgetc(file)) != EOF;) {
		if (!*text || length + 2 > *size) {
			size_t larger = *text && *size >= 60 ? 2 * *size : 120;
			char *area = plc_realloc(heap, *text, larger);
			if (!area) {
				errno = ENOMEM;
				return -1;
			}
			*text = area;
			*size = larger;
		}
		(*text)[length++] = (char)c;
		if (c == last)
			break;
	}
	if (!length)
		return -1;
	(*text)[length] = 0;
	return (long)length;
}

long plc_getline(struct plc_heap *heap, char **text, size_t *size, FILE *file)
{
	return plc_getdelim(heap, text, size, '\n', file);
}
