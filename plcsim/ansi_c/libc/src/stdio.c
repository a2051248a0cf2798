/* The scan's standard output. */

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "host.h"

size_t fwrite(const void *area, size_t size, size_t count, FILE *file)
{
	plc_write((int)(size_t)file, area, size * count);
	return count;
}

int fputs(const char *text, FILE *file)
{
	fwrite(text, 1, strlen(text), file);
	return 0;
}

int puts(const char *text) { return printf("%s\n", text); }

int fputc(int character, FILE *file)
{
	char byte = (char)character;
	fwrite(&byte, 1, 1, file);
	return (unsigned char)character;
}

int putc(int character, FILE *file) { return fputc(character, file); }
int putchar(int character) { return fputc(character, stdout); }
int fflush(FILE *file) { return (void)file, 0; }
int ferror(FILE *file) { return (void)file, 0; }

void perror(const char *text)
{
	fprintf(stderr, "%s%s%s\n", text ? text : "", text && *text ? ": " : "", strerror(errno));
}
