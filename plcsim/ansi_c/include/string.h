/* Strings and memory (ISO C 7.24), and what POSIX adds that programs for the controller use. */

#ifndef PLCSIM_STRING_H
#define PLCSIM_STRING_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

void *memcpy(void *target, const void *source, size_t count);
void *memmove(void *target, const void *source, size_t count);
void *memset(void *target, int value, size_t count);
int memcmp(const void *a, const void *b, size_t count);
void *memchr(const void *area, int value, size_t count);

size_t strlen(const char *text);
size_t strnlen(const char *text, size_t most);
char *strcpy(char *target, const char *source);
char *strncpy(char *target, const char *source, size_t count);
char *stpcpy(char *target, const char *source);
char *strcat(char *target, const char *source);
char *strncat(char *target, const char *source, size_t most);
int strcmp(const char *a, const char *b);
int strncmp(const char *a, const char *b, size_t most);
int strcoll(const char *a, const char *b);
int strcasecmp(const char *a, const char *b);
int strncasecmp(const char *a, const char *b, size_t most);
char *strchr(const char *text, int character);
char *strrchr(const char *text, int character);
char *strstr(const char *text, const char *part);
char *strpbrk(const char *text, const char *any);
size_t strspn(const char *text, const char *accepted);
size_t strcspn(const char *text, const char *rejected);
char *strtok(char *text, const char *separators);
char *strtok_r(char *text, const char *separators, char **rest);
char *strsep(char **rest, const char *separators);
char *strcasestr(const char *text, const char *part);
char *stpncpy(char *target, const char *source, size_t count);
void *mempcpy(void *target, const void *source, size_t count);
void *memccpy(void *target, const void *source, int last, size_t count);
void *memmem(const void *area, size_t size, const void *part, size_t length);
char *strchrnul(const char *text, int character); /* where the text ends, if it is not there */
void *rawmemchr(const void *area, int value); /* which is there */
void *memrchr(const void *area, int value, size_t count);
char *strerror(int number);
int strerror_r(int number, char *text, size_t size);
char *strsignal(int number);
char *strdup(const char *text); /* on the heap */
char *strndup(const char *text, size_t most);
size_t strlcpy(char *target, const char *source, size_t size);
size_t strlcat(char *target, const char *source, size_t size);
char *strlwr(char *text); /* in place, as in newlib */
char *strupr(char *text);
size_t strxfrm(char *target, const char *source, size_t count);

#ifdef __cplusplus
}
#endif

#endif
