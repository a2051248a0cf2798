/* Flags of POSIX. There is no open(): files are streams (stdio.h), or those of the library FileIO. */

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

#endif
