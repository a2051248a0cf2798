/* What POSIX declares here stands in <string.h> and below. */

#ifndef PLCSIM_STRINGS_H
#define PLCSIM_STRINGS_H

#include <string.h>

#define bcopy(source, target, count) ((void)memmove(target, source, count))
#define bzero(area, count) ((void)memset(area, 0, count))
#define bcmp(a, b, count) memcmp(a, b, count)
#define index(text, character) strchr(text, character)
#define rindex(text, character) strrchr(text, character)

#ifdef __cplusplus
extern "C" {
#endif

int ffs(int value); /* number of the lowest bit that is set, from 1; 0 for none */
int ffsl(long value);
int ffsll(long long value);

#ifdef __cplusplus
}
#endif

#endif
