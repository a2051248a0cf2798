/* Waiting for sockets (POSIX), of which there are none. */

#ifndef PLCSIM_POLL_H
#define PLCSIM_POLL_H

#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

#define POLLIN 1
#define POLLPRI 2
#define POLLOUT 4
#define POLLERR 8
#define POLLHUP 16
#define POLLNVAL 32

typedef unsigned nfds_t;
struct pollfd {
	int fd;
	short events, revents;
};

int poll(struct pollfd *files, nfds_t count, int timeout)
	__attribute__((diagnose_if(1, "a unit never waits, and a controller has no sockets of POSIX: poll fails", "warning")));

#ifdef __cplusplus
}
#endif

#endif
