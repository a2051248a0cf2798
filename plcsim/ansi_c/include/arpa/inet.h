/* Addresses of IP (POSIX). */

#ifndef PLCSIM_ARPA_INET_H
#define PLCSIM_ARPA_INET_H

#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef uint16_t in_port_t;
typedef uint32_t in_addr_t;
struct in_addr {
	in_addr_t s_addr;
};
struct in6_addr {
	uint8_t s6_addr[16];
};

static inline uint16_t htons(uint16_t number) { return __builtin_bswap16(number); }
static inline uint16_t ntohs(uint16_t number) { return __builtin_bswap16(number); }
static inline uint32_t htonl(uint32_t number) { return __builtin_bswap32(number); }
static inline uint32_t ntohl(uint32_t number) { return __builtin_bswap32(number); }

in_addr_t inet_addr(const char *text);
int inet_aton(const char *text, struct in_addr *address);
char *inet_ntoa(struct in_addr address);
int inet_pton(int family, const char *text, void *address); /* AF_INET */
const char *inet_ntop(int family, const void *address, char *text, socklen_t size);

#ifdef __cplusplus
}
#endif

#endif
