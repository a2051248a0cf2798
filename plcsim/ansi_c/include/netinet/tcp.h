/* Options of TCP (POSIX); see sys/socket.h. */

#ifndef PLCSIM_NETINET_TCP_H
#define PLCSIM_NETINET_TCP_H

#define SOL_TCP 6 /* IPPROTO_TCP */
#define TCP_NODELAY 1
#define TCP_MAXSEG 2
#define TCP_KEEPIDLE 4
#define TCP_KEEPINTVL 5
#define TCP_KEEPCNT 6

#endif
