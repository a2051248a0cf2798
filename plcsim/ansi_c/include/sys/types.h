/* Types of POSIX. */

#ifndef PLCSIM_SYS_TYPES_H
#define PLCSIM_SYS_TYPES_H

#include <stddef.h>
#include <stdint.h>
#include <time.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FD_SETSIZE 64
#define FD_ZERO(set) ((set)->bits[0] = (set)->bits[1] = 0)
#define FD_SET(number, set) ((set)->bits[(number) / 32 & 1] |= 1u << ((number) & 31))
#define FD_CLR(number, set) ((set)->bits[(number) / 32 & 1] &= ~(1u << ((number) & 31)))
#define FD_ISSET(number, set) ((set)->bits[(number) / 32 & 1] >> ((number) & 31) & 1)

typedef struct fd_set {
	uint32_t bits[FD_SETSIZE / 32];
} fd_set; /* numbers; see sys/select.h */

typedef long ssize_t;
typedef long off_t;
typedef int pid_t;
typedef unsigned uid_t;
typedef unsigned gid_t;
typedef unsigned mode_t;
typedef unsigned dev_t;
typedef unsigned long ino_t;
typedef unsigned nlink_t;
typedef unsigned socklen_t;
typedef unsigned id_t;
typedef long suseconds_t;
typedef unsigned useconds_t;
typedef unsigned char u_char;
typedef unsigned short u_short;
typedef unsigned u_int;
typedef unsigned long u_long;
typedef uint8_t u_int8_t;
typedef uint16_t u_int16_t;
typedef uint32_t u_int32_t;
typedef uint64_t u_int64_t;

#ifdef __cplusplus
}
#endif

#endif
