/* Limits of types, which the compiler knows, and of POSIX. */

#include_next <limits.h>

#ifndef PLCSIM_LIMITS_H
#define PLCSIM_LIMITS_H

#define PATH_MAX 260
#define NAME_MAX 255
#define HOST_NAME_MAX 63
#define OPEN_MAX 64
#define SSIZE_MAX LONG_MAX

#endif
