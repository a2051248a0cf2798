/* Formatted texts (ISO C 7.19), and the scan's standard output. There are no files: those of the
 * controller are opened by the library FileIO. */

#ifndef PLCSIM_STDIO_H
#define PLCSIM_STDIO_H

#include <stdarg.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define EOF (-1)
#define BUFSIZ 256

typedef struct plc_stream FILE;

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
int putchar(int character);
int putc(int character, FILE *file);
int fputc(int character, FILE *file);
size_t fwrite(const void *area, size_t size, size_t count, FILE *file);
int fflush(FILE *file);
int ferror(FILE *file);
void perror(const char *text);

#undef PLC_FORMAT

#ifdef __cplusplus
}
#endif

#endif
