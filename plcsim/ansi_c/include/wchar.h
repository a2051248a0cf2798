/* Wide characters (ISO C 7.24): Unicode, of 32 bits; in texts of bytes they are UTF-8. */

#ifndef PLCSIM_WCHAR_H
#define PLCSIM_WCHAR_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifndef WCHAR_MIN
#define WCHAR_MIN INT32_MIN
#define WCHAR_MAX INT32_MAX
#endif
#define WEOF ((wint_t)-1)

typedef __WINT_TYPE__ wint_t;

typedef struct {
	unsigned char bytes[4];
} mbstate_t; /* for <string> of C++, which asks that there is one */

size_t wcslen(const wchar_t *text);
wchar_t *wcscpy(wchar_t *target, const wchar_t *source);
wchar_t *wcsncpy(wchar_t *target, const wchar_t *source, size_t count);
wchar_t *wcscat(wchar_t *target, const wchar_t *source);
int wcscmp(const wchar_t *a, const wchar_t *b);
int wcsncmp(const wchar_t *a, const wchar_t *b, size_t most);
wchar_t *wcschr(const wchar_t *text, wchar_t character);
wchar_t *wcsrchr(const wchar_t *text, wchar_t character);
wchar_t *wcsstr(const wchar_t *text, const wchar_t *part);
wchar_t *wmemcpy(wchar_t *target, const wchar_t *source, size_t count);
wchar_t *wmemmove(wchar_t *target, const wchar_t *source, size_t count);
wchar_t *wmemset(wchar_t *target, wchar_t value, size_t count);
int wmemcmp(const wchar_t *a, const wchar_t *b, size_t count);
wchar_t *wmemchr(const wchar_t *area, wchar_t value, size_t count);
size_t mbstowcs(wchar_t *target, const char *source, size_t count);
size_t wcstombs(char *target, const wchar_t *source, size_t size);

#ifdef __cplusplus
}
#endif

#endif
