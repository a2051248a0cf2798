/* Streams: the scan's standard output, and files on the file devices of the controller. */

#include <errno.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

/* A file. The buffer holds what lies in it from `place` on. */
struct plc_stream {
	char is_open, reads, writes, appends, has_ended, has_failed;
	char changed; /* whether the buffer is to be written */
	int file;
	int back; /* a character put back by ungetc, or EOF */
	size_t place, next, filled;
	char buffer[BUFSIZ];
};

static struct plc_stream streams[FOPEN_MAX];

static int failed(FILE *file, int error)
{
	if (file)
		file->has_failed = 1;
	errno = error < 0 ? -error : error;
	return EOF;
}

/* stdout and stderr are not buffered, as more than one program writes to them. */
static int is_standard(const FILE *file) { return file == stdin || file == stdout || file == stderr; }

static int is_open(FILE *file)
{
	if ((uintptr_t)file >= (uintptr_t)streams && (uintptr_t)file < (uintptr_t)(streams + FOPEN_MAX)
	    && file->is_open)
		return 1;
	if (!is_standard(file))
		errno = EBADF;
	return 0;
}

static int read_mode(const char *mode, FILE *file)
{
	int is_both = strchr(mode, '+') != 0, flags;
	switch (*mode) {
	case 'r':
		flags = PLC_READ;
		break;
	case 'w':
		flags = PLC_WRITE | PLC_CREATE | PLC_TRUNCATE;
		break;
	case 'a':
		flags = PLC_WRITE | PLC_CREATE;
		break;
	default:
		return 0;
	}
	if (is_both)
		flags |= PLC_READ | PLC_WRITE;
	if (strchr(mode, 'x'))
		flags |= PLC_EXCLUSIVE;
	file->reads = (flags & PLC_READ) != 0;
	file->writes = (flags & PLC_WRITE) != 0;
	file->appends = *mode == 'a';
	return flags;
}

static FILE *open_as(FILE *file, const char *path, const char *mode)
{
	memset(file, 0, offsetof(FILE, buffer));
	int flags = read_mode(mode, file);
	int number = flags ? plc_file_open(path, flags) : -EINVAL;
	if (number < 0) {
		errno = -number;
		return 0;
	}
	file->file = number;
	file->back = EOF;
	file->is_open = 1;
	return file;
}

FILE *fopen(const char *path, const char *mode)
{
	for (FILE *file = streams; file < streams + FOPEN_MAX; file++)
		if (!file->is_open)
			return open_as(file, path, mode);
	errno = EMFILE;
	return 0;
}

static int forget(FILE *file)
{
	file->place += file->next;
	file->next = file->filled = 0;
	return 0;
}

int fflush(FILE *file)
{
	if (!file) {
		int result = 0;
		for (FILE *each = streams; each < streams + FOPEN_MAX; each++)
			if (each->is_open && fflush(each))
				result = EOF;
		return result;
	}
	if (!is_open(file))
		return is_standard(file) ? 0 : EOF;
	if (!file->changed)
		return 0;
	file->changed = 0;
	int written = plc_file_write(file->file, file->buffer, file->filled, file->place);
	return written < 0 ? failed(file, written) : 0;
}

int fclose(FILE *file)
{
	if (!is_open(file))
		return is_standard(file) ? 0 : EOF;
	int result = fflush(file);
	file->is_open = 0;
	int error = plc_file_close(file->file);
	return error < 0 ? failed(0, error) : result;
}

FILE *freopen(const char *path, const char *mode, FILE *file)
{
	if (fclose(file) || is_standard(file))
		return 0;
	return open_as(file, path, mode);
}

/* Brings the next bytes into the buffer; returns whether there are any. */
static int fill(FILE *file)
{
	if (file->next < file->filled)
		return 1;
	if (fflush(file))
		return 0;
	forget(file);
	int count = plc_file_read(file->file, file->buffer, BUFSIZ, file->place);
	if (count < 0)
		return failed(file, count), 0;
	file->filled = (size_t)count;
	file->has_ended |= !count;
	return count > 0;
}

static int may_read(FILE *file)
{
	if (!is_open(file))
		return 0;
	return file->reads || (failed(file, EBADF), 0);
}

size_t fread(void *area, size_t size, size_t count, FILE *file)
{
	size_t whole = size * count, done = 0;
	char *to = area;
	if (!whole || !may_read(file))
		return 0;
	if (count > SIZE_MAX / size)
		return failed(file, EOVERFLOW), 0;
	if (file->back != EOF) {
		to[done++] = (char)file->back;
		file->back = EOF;
	}
	while (done < whole && fill(file)) {
		size_t there = file->filled - file->next, part = whole - done < there ? whole - done : there;
		memcpy(to + done, file->buffer + file->next, part);
		file->next += part;
		done += part;
	}
	return done / size;
}

int fgetc(FILE *file)
{
	unsigned char byte;
	return fread(&byte, 1, 1, file) ? byte : EOF;
}

int getc(FILE *file) { return fgetc(file); }
int getchar(void) { return EOF; }

int ungetc(int character, FILE *file)
{
	if (character == EOF || !may_read(file) || file->back != EOF)
		return EOF;
	file->has_ended = 0;
	return file->back = (unsigned char)character;
}

char *fgets(char *text, int size, FILE *file)
{
	int length = 0, character = 0;
	while (length < size - 1 && character != '\n' && (character = fgetc(file)) != EOF)
		text[length++] = (char)character;
	if (size > 0)
		text[length] = 0;
	return length && !ferror(file) ? text : 0;
}

/* Brings the place to write to into the buffer; returns whether there is room. */
static int make_room(FILE *file)
{
	if (file->appends && !file->changed) {
		int size = plc_file_size(file->file);
		if (size < 0)
			return failed(file, size), 0;
		file->place = (size_t)size;
		file->next = file->filled = 0;
	}
	if (file->next < BUFSIZ)
		return 1;
	if (fflush(file))
		return 0;
	forget(file);
	return 1;
}

static size_t write_to(FILE *file, const char *from, size_t whole)
{
	size_t done = 0;
	if (file->back != EOF)
		fseek(file, 0, SEEK_CUR);
	while (done < whole && make_room(file)) {
		size_t room = BUFSIZ - file->next, part = whole - done < room ? whole - done : room;
		memcpy(file->buffer + file->next, from + done, part);
		file->next += part;
		if (file->filled < file->next)
			file->filled = file->next;
		file->changed = 1;
		done += part;
	}
	return done;
}

size_t fwrite(const void *area, size_t size, size_t count, FILE *file)
{
	if (!size || !count)
		return 0;
	if (file == stdout || file == stderr) {
		plc_write((int)(uintptr_t)file, area, size * count);
		return count;
	}
	if (!is_open(file))
		return 0;
	if (!file->writes || count > SIZE_MAX / size)
		return failed(file, file->writes ? EOVERFLOW : EBADF), 0;
	return write_to(file, area, size * count) / size;
}

int fputs(const char *text, FILE *file)
{
	size_t length = strlen(text);
	return fwrite(text, 1, length, file) == length ? 0 : EOF;
}

int puts(const char *text) { return printf("%s\n", text); }

int fputc(int character, FILE *file)
{
	char byte = (char)character;
	return fwrite(&byte, 1, 1, file) ? (unsigned char)character : EOF;
}

int putc(int character, FILE *file) { return fputc(character, file); }
int putchar(int character) { return fputc(character, stdout); }

long ftell(FILE *file)
{
	if (!is_open(file))
		return -1;
	return (long)(file->place + file->next) - (file->back != EOF);
}

int fseek(FILE *file, long offset, int origin)
{
	if (!is_open(file))
		return -1;
	long long from = 0;
	if (fflush(file))
		return -1;
	if (origin == SEEK_CUR)
		from = ftell(file);
	else if (origin == SEEK_END)
		from = plc_file_size(file->file);
	if (origin < SEEK_SET || origin > SEEK_END || from + offset < 0 || from + offset > LONG_MAX) {
		errno = EINVAL;
		return -1;
	}
	file->place = (size_t)(from + offset);
	file->next = file->filled = 0;
	file->back = EOF;
	file->has_ended = 0;
	return 0;
}

long ftello(FILE *file) { return ftell(file); }
int fseeko(FILE *file, long offset, int origin) { return fseek(file, offset, origin); }

void rewind(FILE *file)
{
	fseek(file, 0, SEEK_SET);
	clearerr(file);
}

int fgetpos(FILE *file, fpos_t *place)
{
	*place = ftell(file);
	return *place < 0 ? -1 : 0;
}

int fsetpos(FILE *file, const fpos_t *place) { return fseek(file, *place, SEEK_SET); }

int feof(FILE *file) { return file == stdin || (is_open(file) && file->has_ended); }
int ferror(FILE *file) { return is_open(file) && file->has_failed; }

void clearerr(FILE *file)
{
	if (is_open(file))
		file->has_ended = file->has_failed = 0;
}

int fileno(FILE *file)
{
	if (is_standard(file))
		return file == stdin ? 0 : (int)(uintptr_t)file;
	return is_open(file) ? file->file + 3 : -1;
}

int setvbuf(FILE *file, char *area, int mode, size_t size)
{
	return (void)file, (void)area, (void)mode, (void)size, 0;
}

void setbuf(FILE *file, char *area) { (void)file, (void)area; }

static int told(int error)
{
	if (error >= 0)
		return 0;
	errno = -error;
	return -1;
}

int remove(const char *path) { return told(plc_file_remove(path)); }
int rename(const char *from, const char *to) { return told(plc_file_rename(from, to)); }

void perror(const char *text)
{
	fprintf(stderr, "%s%s%s\n", text ? text : "", text && *text ? ": " : "", strerror(errno));
}

#define LONGEST_INPUT 2000 /* characters that one call of fscanf looks at */

int plc_scan(const char *text, const char *format, va_list targets, size_t *read);

int vfscanf(FILE *file, const char *format, va_list targets)
{
	char text[LONGEST_INPUT + 1];
	size_t read = 0;
	long place = ftell(file);
	size_t length = fread(text, 1, LONGEST_INPUT, file);
	if (!length)
		return EOF;
	text[length] = 0;
	int count = plc_scan(text, format, targets, &read);
	if (read < length)
		fseek(file, place + (long)read, SEEK_SET);
	return count;
}

int fscanf(FILE *file, const char *format, ...)
{
	va_list targets;
	va_start(targets, format);
	int count = vfscanf(file, format, targets);
	va_end(targets);
	return count;
}

int scanf(const char *format, ...) { return (void)format, EOF; }
