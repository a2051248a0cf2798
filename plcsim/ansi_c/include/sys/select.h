/* Waiting for sockets (POSIX), of which there are none. */

#ifndef PLCSIM_SYS_SELECT_H
#define PLCSIM_SYS_SELECT_H

#include <sys/time.h>

#ifdef __cplusplus
extern "C" {
#endif

int select(int count, fd_set *readable, fd_set *writable, fd_set *exceptional, struct timeval *most)
	__attribute__((diagnose_if(1, "a unit never waits, and a controller has no sockets of POSIX: select fails", "warning")));

#ifdef __cplusplus
}
#endif

#endif
