/* Flags of POSIX. Files lie on the file devices of the controller, as those of stdio.h. */

#ifndef PLCSIM_FCNTL_H
#define PLCSIM_FCNTL_H

#include <sys/types.h>

#define O_RDONLY 0
#define O_WRONLY 1
#define O_RDWR 2
#define O_APPEND 8
#define O_CREAT 0x200
#define O_TRUNC 0x400
#define O_EXCL 0x800
#define O_NONBLOCK 0x4000
#define F_GETFL 3
#define F_SETFL 4
#define F_GETFD 1
#define F_SETFD 2
#define FD_CLOEXEC 1
#define O_CLOEXEC 0x40000
#define O_BINARY 0

#ifdef __cplusplus
extern "C" {
#endif

int open(const char *path, int flags, ...);
int creat(const char *path, mode_t mode);
int fcntl(int file, int command, ...); /* EINVAL, other than to get flags */

#ifdef __cplusplus
}
#endif

#endif
