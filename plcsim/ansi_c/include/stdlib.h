/* Numbers, memory, searching and sorting (ISO C 7.20). Memory comes from the heap of the program. */

#ifndef _STDLIB_H_ /* as in newlib: projects bring copies of its header, which take the place of this one */
#define _STDLIB_H_

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define EXIT_SUCCESS 0
#define EXIT_FAILURE 1
#define RAND_MAX 0x7fffffff
#define MB_CUR_MAX 1

typedef struct { int quot, rem; } div_t;
typedef struct { long quot, rem; } ldiv_t;
typedef struct { long long quot, rem; } lldiv_t;

void *malloc(size_t size);
void *calloc(size_t count, size_t size);
void *realloc(void *area, size_t size);
void free(void *area);
void *aligned_alloc(size_t alignment, size_t size);
void *reallocarray(void *area, size_t count, size_t size);
#define posix_memalign(area, alignment, size) \
	((*(area) = aligned_alloc(alignment, size)) ? 0 : 12 /* ENOMEM */)

int atoi(const char *text);
long atol(const char *text);
long long atoll(const char *text);
double atof(const char *text);
long strtol(const char *text, char **end, int base);
unsigned long strtoul(const char *text, char **end, int base);
long long strtoll(const char *text, char **end, int base);
unsigned long long strtoull(const char *text, char **end, int base);
float strtof(const char *text, char **end);
double strtod(const char *text, char **end);
long double strtold(const char *text, char **end);

int abs(int value);
long labs(long value);
long long llabs(long long value);
div_t div(int number, int by);
ldiv_t ldiv(long number, long by);
lldiv_t lldiv(long long number, long long by);

int rand(void);
int rand_r(unsigned *state);
void srand(unsigned seed);

void qsort(void *area, size_t count, size_t size, int (*compare)(const void *, const void *));
void *bsearch(const void *key, const void *area, size_t count, size_t size,
              int (*compare)(const void *, const void *));

/* Both end the controller's run, as a fault. */
void abort(void) __attribute__((__noreturn__));
void exit(int status) __attribute__((__noreturn__));

void _Exit(int status) __attribute__((__noreturn__));
int atexit(void (*function)(void)); /* never called: a program does not exit */

char *getenv(const char *name); /* NULL */
int setenv(const char *name, const char *value, int replace); /* ENOSYS, as the next two */
int unsetenv(const char *name);
int putenv(char *text);
int system(const char *command); /* NULL: 0, there is none; else ENOSYS */
char *realpath(const char *path, char *real); /* real is to be given */
long random(void);
void srandom(unsigned seed);
char *itoa(int value, char *text, int base);
char *utoa(unsigned value, char *text, int base);

int mblen(const char *text, size_t size);
int mbtowc(wchar_t *character, const char *text, size_t size);
int wctomb(char *text, wchar_t character);
size_t mbstowcs(wchar_t *target, const char *source, size_t count);
size_t wcstombs(char *target, const wchar_t *source, size_t size);

#ifdef __cplusplus
}
#endif

#endif
