/* Formatted texts, the scan's standard output, and files (ISO C 7.19).
 *
 * Files lie on the file devices of the controller, as [library.FileIO] of plc.toml names them: a path
 * begins with the name of a device ("F:/data/a.txt"), or lies on the first one. Other than the
 * blocks of the library FileIO, these functions do all of it at once, within the cycle. There is
 * nothing to read from stdin. */

#ifndef PLCSIM_STDIO_H
#define PLCSIM_STDIO_H

#include <stdarg.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define EOF (-1)
#define BUFSIZ 512
#define FOPEN_MAX 16
#define FILENAME_MAX 260
#define L_tmpnam 32
#define SEEK_SET 0
#define SEEK_CUR 1
#define SEEK_END 2
#define _IOFBF 0
#define _IOLBF 1
#define _IONBF 2

typedef struct plc_stream FILE;
typedef long fpos_t;

/* Addresses that nobody looks at. */
#define stdin ((FILE *)3)
#define stdout ((FILE *)1)
#define stderr ((FILE *)2)

#define PLC_FORMAT(text, first) __attribute__((__format__(printf, text, first)))

int printf(const char *format, ...) PLC_FORMAT(1, 2);
int fprintf(FILE *file, const char *format, ...) PLC_FORMAT(2, 3);
int sprintf(char *text, const char *format, ...) PLC_FORMAT(2, 3);
int snprintf(char *text, size_t size, const char *format, ...) PLC_FORMAT(3, 4);
int vprintf(const char *format, va_list values) PLC_FORMAT(1, 0);
int vfprintf(FILE *file, const char *format, va_list values) PLC_FORMAT(2, 0);
int vsprintf(char *text, const char *format, va_list values) PLC_FORMAT(2, 0);
int vsnprintf(char *text, size_t size, const char *format, va_list values) PLC_FORMAT(3, 0);
int sscanf(const char *text, const char *format, ...) __attribute__((__format__(scanf, 2, 3)));
int vsscanf(const char *text, const char *format, va_list targets);

int puts(const char *text);
int fputs(const char *text, FILE *file);
int asprintf(char **text, const char *format, ...) PLC_FORMAT(2, 3); /* on the heap */
int vasprintf(char **text, const char *format, va_list values) PLC_FORMAT(2, 0);
int putchar(int character);
int putc(int character, FILE *file);
int fputc(int character, FILE *file);
size_t fwrite(const void *area, size_t size, size_t count, FILE *file);
void perror(const char *text);

FILE *fopen(const char *path, const char *mode);
FILE *freopen(const char *path, const char *mode, FILE *file);
int fclose(FILE *file);
int fflush(FILE *file); /* NULL: all of them */
size_t fread(void *area, size_t size, size_t count, FILE *file);
int fgetc(FILE *file);
int getc(FILE *file);
int getchar(void); /* EOF */
int ungetc(int character, FILE *file);
char *fgets(char *text, int size, FILE *file);
long getline(char **text, size_t *size, FILE *file); /* on the heap */
long getdelim(char **text, size_t *size, int last, FILE *file);
int fscanf(FILE *file, const char *format, ...) __attribute__((__format__(scanf, 2, 3)));
int vfscanf(FILE *file, const char *format, va_list targets);
int scanf(const char *format, ...) __attribute__((__format__(scanf, 1, 2))); /* EOF */
long ftell(FILE *file);
int fseek(FILE *file, long offset, int origin);
long ftello(FILE *file);
int fseeko(FILE *file, long offset, int origin);
void rewind(FILE *file);
int fgetpos(FILE *file, fpos_t *place);
int fsetpos(FILE *file, const fpos_t *place);
int feof(FILE *file);
int ferror(FILE *file);
void clearerr(FILE *file);
int fileno(FILE *file);
int setvbuf(FILE *file, char *area, int mode, size_t size); /* buffers stay as they are */
void setbuf(FILE *file, char *area);
int remove(const char *path);
int rename(const char *from, const char *to);

#undef PLC_FORMAT

#ifdef __cplusplus
}
#endif

#endif
