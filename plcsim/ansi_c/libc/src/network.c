/* Addresses and names of the network, as text; and the sockets of POSIX, which are not there. */

#include <arpa/inet.h>
#include <errno.h>
#include <netdb.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int h_errno;

/* Reads "a.b.c.d" as inet_pton does; returns whether that is all of the text. */
static int read_address(const char *text, unsigned char *bytes)
{
	for (int part = 0; part < 4; part++) {
		unsigned number = 0, digits = 0;
		for (; *text >= '0' && *text <= '9' && digits < 4; text++, digits++)
			number = 10 * number + (unsigned)(*text - '0');
		if (!digits || digits > 3 || number > 255 || *text != (part < 3 ? '.' : 0))
			return 0;
		text += part < 3;
		bytes[part] = (unsigned char)number;
	}
	return 1;
}

int inet_pton(int family, const char *text, void *address)
{
	if (family == AF_INET)
		return read_address(text, address);
	errno = EAFNOSUPPORT;
	return -1;
}

const char *inet_ntop(int family, const void *address, char *text, socklen_t size)
{
	const unsigned char *b = address;
	if (family != AF_INET) {
		errno = EAFNOSUPPORT;
		return 0;
	}
	if (snprintf(text, size, "%u.%u.%u.%u", b[0], b[1], b[2], b[3]) < (int)size)
		return text;
	errno = ENOSPC;
	return 0;
}

int inet_aton(const char *text, struct in_addr *address) { return read_address(text, (unsigned char *)address); }

in_addr_t inet_addr(const char *text)
{
	struct in_addr address;
	return inet_aton(text, &address) ? address.s_addr : INADDR_NONE;
}

char *inet_ntoa(struct in_addr address)
{
	static char text[INET_ADDRSTRLEN];
	return (char *)inet_ntop(AF_INET, &address, text, sizeof text);
}

static int find(const char *host, struct in_addr *address)
{
	return inet_aton(!strcmp(host, "localhost") || !strcmp(host, "plc") ? "127.0.0.1" : host, address);
}

#define KEPT 8

int getaddrinfo(const char *host, const char *service, const struct addrinfo *wanted,
                struct addrinfo **found)
{
	static struct {
		struct addrinfo info;
		struct sockaddr_in address;
	} kept[KEPT];
	static unsigned next;
	int family = wanted ? wanted->ai_family : AF_UNSPEC, flags = wanted ? wanted->ai_flags : 0;
	struct in_addr address = {htonl(flags & AI_PASSIVE ? INADDR_ANY : INADDR_LOOPBACK)};
	char *end = 0;
	long port = service ? strtol(service, &end, 10) : 0;
	if (family != AF_UNSPEC && family != AF_INET)
		return EAI_FAMILY;
	if (!host && !service)
		return EAI_NONAME;
	if (service && (!*service || *end || port < 0 || port > 65535))
		return EAI_SERVICE;
	if (host && !find(host, &address))
		return EAI_NONAME;
	next = (next + 1) % KEPT;
	memset(&kept[next], 0, sizeof kept[next]);
	kept[next].address.sin_family = AF_INET;
	kept[next].address.sin_port = htons((uint16_t)port);
	kept[next].address.sin_addr = address;
	kept[next].info.ai_family = AF_INET;
	kept[next].info.ai_socktype = wanted && wanted->ai_socktype ? wanted->ai_socktype : SOCK_STREAM;
	kept[next].info.ai_protocol = kept[next].info.ai_socktype == SOCK_DGRAM ? IPPROTO_UDP : IPPROTO_TCP;
	kept[next].info.ai_addrlen = sizeof kept[next].address;
	kept[next].info.ai_addr = (struct sockaddr *)&kept[next].address;
	*found = &kept[next].info;
	return 0;
}

void freeaddrinfo(struct addrinfo *found) { (void)found; }

const char *gai_strerror(int error)
{
	switch (error) {
	case 0:
		return "no error";
	case EAI_NONAME:
		return "unknown host: without a name server only addresses and localhost are known";
	case EAI_SERVICE:
		return "no number of a port";
	case EAI_FAMILY:
		return "no addresses of this family";
	case EAI_OVERFLOW:
		return "too little room";
	}
	return "cannot be found";
}

int getnameinfo(const struct sockaddr *address, socklen_t size, char *host, socklen_t host_size,
                char *service, socklen_t service_size, int flags)
{
	const struct sockaddr_in *in = (const struct sockaddr_in *)address;
	(void)flags;
	if (size < sizeof *in || in->sin_family != AF_INET)
		return EAI_FAMILY;
	if (host && host_size && !inet_ntop(AF_INET, &in->sin_addr, host, host_size))
		return EAI_OVERFLOW;
	if (service && service_size
	    && snprintf(service, service_size, "%u", ntohs(in->sin_port)) >= (int)service_size)
		return EAI_OVERFLOW;
	return 0;
}

struct hostent *gethostbyname(const char *name)
{
	static struct in_addr address;
	static char *addresses[] = {(char *)&address, 0}, *aliases[] = {0}, text[NI_MAXHOST];
	static struct hostent found = {text, aliases, AF_INET, sizeof address, addresses};
	if (!find(name, &address)) {
		h_errno = HOST_NOT_FOUND;
		return 0;
	}
	strlcpy(text, name, sizeof text);
	return &found;
}

/* Each of these is called with what it is to do, and cannot do it. */

struct timeval;
struct pollfd;

static int not_there(void)
{
	errno = ENOSYS;
	return -1;
}

int socket(int f, int t, int p) { return (void)f, (void)t, (void)p, not_there(); }
int bind(int s, const struct sockaddr *a, socklen_t n) { return (void)s, (void)a, (void)n, not_there(); }
int listen(int s, int n) { return (void)s, (void)n, not_there(); }
int accept(int s, struct sockaddr *a, socklen_t *n) { return (void)s, (void)a, (void)n, not_there(); }
int connect(int s, const struct sockaddr *a, socklen_t n) { return (void)s, (void)a, (void)n, not_there(); }
int shutdown(int s, int how) { return (void)s, (void)how, not_there(); }
int getsockname(int s, struct sockaddr *a, socklen_t *n) { return (void)s, (void)a, (void)n, not_there(); }
int getpeername(int s, struct sockaddr *a, socklen_t *n) { return (void)s, (void)a, (void)n, not_there(); }
int poll(struct pollfd *f, unsigned n, int t) { return (void)f, (void)n, (void)t, not_there(); }

ssize_t send(int s, const void *area, size_t count, int flags)
{
	return (void)s, (void)area, (void)count, (void)flags, not_there();
}

ssize_t recv(int s, void *area, size_t count, int flags)
{
	return (void)s, (void)area, (void)count, (void)flags, not_there();
}

ssize_t sendto(int s, const void *area, size_t count, int flags, const struct sockaddr *a, socklen_t n)
{
	return (void)s, (void)area, (void)count, (void)flags, (void)a, (void)n, not_there();
}

ssize_t recvfrom(int s, void *area, size_t count, int flags, struct sockaddr *a, socklen_t *n)
{
	return (void)s, (void)area, (void)count, (void)flags, (void)a, (void)n, not_there();
}

int setsockopt(int s, int level, int name, const void *value, socklen_t n)
{
	return (void)s, (void)level, (void)name, (void)value, (void)n, not_there();
}

int getsockopt(int s, int level, int name, void *value, socklen_t *n)
{
	return (void)s, (void)level, (void)name, (void)value, (void)n, not_there();
}

int select(int n, fd_set *r, fd_set *w, fd_set *x, struct timeval *most)
{
	return (void)n, (void)r, (void)w, (void)x, (void)most, not_there();
}
