/* What a function of the C library could not do. */

#ifndef PLCSIM_ERRNO_H
#define PLCSIM_ERRNO_H

#ifdef __cplusplus
extern "C" {
#endif

extern int errno;

#define EPERM 1
#define ENOENT 2
#define EINTR 4
#define EIO 5
#define ENXIO 6
#define E2BIG 7
#define ENOEXEC 8
#define EBADF 9
#define ECHILD 10
#define EAGAIN 11
#define EWOULDBLOCK EAGAIN
#define ENOMEM 12
#define EACCES 13
#define EFAULT 14
#define EBUSY 16
#define EEXIST 17
#define EXDEV 18
#define ENODEV 19
#define ENOTDIR 20
#define EISDIR 21
#define EINVAL 22
#define ENFILE 23
#define EMFILE 24
#define ENOTTY 25
#define EFBIG 27
#define ENOSPC 28
#define ESPIPE 29
#define EROFS 30
#define EPIPE 32
#define EDOM 33
#define ERANGE 34
#define ENOSYS 88
#define ETIMEDOUT 116
#define ECONNREFUSED 111
#define ECONNRESET 104
#define EINPROGRESS 119
#define EALREADY 120
#define ENOTCONN 128
#define EISCONN 127
#define ESRCH 3
#define ENOTBLK 15
#define ETXTBSY 26
#define EMLINK 31
#define EDEADLK 45
#define ENODATA 61
#define ETIME 62
#define EBADMSG 77
#define ELOOP 92
#define EOPNOTSUPP 95
#define EPFNOSUPPORT 96
#define EAFNOSUPPORT 106
#define EPROTOTYPE 107
#define ENOPROTOOPT 109
#define ENETUNREACH 114
#define ENETDOWN 115
#define EHOSTDOWN 117
#define EHOSTUNREACH 118
#define EDESTADDRREQ 121
#define EMSGSIZE 122
#define EPROTONOSUPPORT 123
#define ENETRESET 126
#define ECANCELED 140
#define ENOTSUP 134
#define ENOTEMPTY 90
#define ENAMETOOLONG 91
#define EADDRINUSE 112
#define EADDRNOTAVAIL 125
#define ECONNABORTED 113
#define ENOBUFS 105
#define ENOTSOCK 108
#define EPROTO 71
#define EILSEQ 138
#define EOVERFLOW 139

#ifdef __cplusplus
}
#endif

#endif
