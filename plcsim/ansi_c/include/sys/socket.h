/* Names of POSIX that programs share with their peers. There are no sockets: each function fails with
 * ENOSYS, and the compiler warns of it. */

#ifndef PLCSIM_SYS_SOCKET_H
#define PLCSIM_SYS_SOCKET_H

#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

#define AF_UNSPEC 0
#define AF_UNIX 1
#define AF_INET 2
#define AF_INET6 10
#define PF_UNSPEC AF_UNSPEC
#define PF_UNIX AF_UNIX
#define PF_INET AF_INET
#define PF_INET6 AF_INET6
#define SOCK_STREAM 1
#define SOCK_DGRAM 2
#define SOCK_RAW 3
#define SOCK_NONBLOCK 0x4000
#define SOCK_CLOEXEC 0x80000
#define SOL_SOCKET 1
#define SO_REUSEADDR 2
#define SO_ERROR 4
#define SO_BROADCAST 6
#define SO_SNDBUF 7
#define SO_RCVBUF 8
#define SO_KEEPALIVE 9
#define SO_LINGER 13
#define SO_REUSEPORT 15
#define SO_RCVTIMEO 20
#define SO_SNDTIMEO 21
#define SHUT_RD 0
#define SHUT_WR 1
#define SHUT_RDWR 2
#define MSG_PEEK 0x02
#define MSG_DONTWAIT 0x40
#define MSG_WAITALL 0x100
#define MSG_NOSIGNAL 0x4000
#define SOMAXCONN 128

typedef unsigned short sa_family_t;
struct sockaddr {
	sa_family_t sa_family;
	char sa_data[14];
};
struct sockaddr_storage {
	sa_family_t ss_family;
	char ss_data[126];
} __attribute__((aligned(4)));
struct linger {
	int l_onoff, l_linger;
};

#define PLC_NO_SOCKETS \
	__attribute__((diagnose_if(1, "socket fails, a controller has no sockets of POSIX: TCP is the library AsTCP (AsTCP.h)", "warning")))

int socket(int family, int type, int protocol) PLC_NO_SOCKETS;
int bind(int socket, const struct sockaddr *address, socklen_t size) PLC_NO_SOCKETS;
int listen(int socket, int backlog) PLC_NO_SOCKETS;
int accept(int socket, struct sockaddr *address, socklen_t *size) PLC_NO_SOCKETS;
int connect(int socket, const struct sockaddr *address, socklen_t size) PLC_NO_SOCKETS;
ssize_t send(int socket, const void *area, size_t count, int flags) PLC_NO_SOCKETS;
ssize_t recv(int socket, void *area, size_t count, int flags) PLC_NO_SOCKETS;
ssize_t sendto(int socket, const void *area, size_t count, int flags, const struct sockaddr *target,
               socklen_t size) PLC_NO_SOCKETS;
ssize_t recvfrom(int socket, void *area, size_t count, int flags, struct sockaddr *source,
                 socklen_t *size) PLC_NO_SOCKETS;
int shutdown(int socket, int how) PLC_NO_SOCKETS;
int setsockopt(int socket, int level, int name, const void *value, socklen_t size) PLC_NO_SOCKETS;
int getsockopt(int socket, int level, int name, void *value, socklen_t *size) PLC_NO_SOCKETS;
int getsockname(int socket, struct sockaddr *address, socklen_t *size) PLC_NO_SOCKETS;
int getpeername(int socket, struct sockaddr *address, socklen_t *size) PLC_NO_SOCKETS;

#ifdef __cplusplus
}
#endif

#endif
