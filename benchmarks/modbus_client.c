/* A closed-loop Modbus TCP load: each connection has one request on its way.
 *
 *   modbus_client load PORT CONNECTIONS REGISTERS SECONDS
 *       reads REGISTERS holding registers from 0 on; the program under test keeps all of them
 *       equal, so an answer with two values is torn
 *   modbus_client write PORT FIRST REGISTERS SECONDS
 *       writes REGISTERS holding registers from FIRST on with one value, the next one each time
 *   modbus_client echo PORT SECONDS
 *       writes register 0 and reads register 1, into which the program copies it, until it is there
 *
 * Prints one line of JSON.
 */
#define _GNU_SOURCE
#include <arpa/inet.h>
#include <errno.h>
#include <netinet/tcp.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <time.h>
#include <unistd.h>

#define SAMPLES (1 << 22)

static uint32_t samples_us[SAMPLES];
static long sampled;
static long exceptions[256];

struct peer {
    int fd;
    uint16_t transaction;
    int got;
    int64_t sent_ns, answered_ns;
    uint8_t answer[300];
};

static int64_t now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000000000LL + t.tv_nsec;
}

static void fail(const char *what)
{
    perror(what);
    exit(1);
}

static int connected(int port)
{
    struct sockaddr_in a = {.sin_family = AF_INET, .sin_port = htons(port)};
    int one = 1, fd = socket(AF_INET, SOCK_STREAM, 0);
    a.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (fd < 0 || connect(fd, (struct sockaddr *)&a, sizeof a)) fail("connect");
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
    return fd;
}

static void ask(struct peer *p, uint8_t function, uint16_t first, uint16_t second)
{
    p->transaction++;
    uint8_t r[12] = {p->transaction >> 8, p->transaction, 0, 0, 0, 6, 1, function,
                     first >> 8, first, second >> 8, second};
    p->sent_ns = now_ns();
    if (write(p->fd, r, sizeof r) != sizeof r) fail("write");
}

/* Returns 1 once a whole answer is there. */
static int receive(struct peer *p)
{
    int n = read(p->fd, p->answer + p->got, sizeof p->answer - p->got);
    if (n < 0 && errno == EAGAIN) return 0;
    if (n <= 0) fail("read");
    p->got += n;
    if (p->got < 9 || p->got < 6 + (p->answer[4] << 8 | p->answer[5])) return 0;
    if ((p->answer[0] << 8 | p->answer[1]) != p->transaction) {
        fprintf(stderr, "an answer to another request\n");
        exit(1);
    }
    p->got = 0;
    p->answered_ns = now_ns();
    samples_us[sampled++ % SAMPLES] = (p->answered_ns - p->sent_ns) / 1000; /* the latest ones */
    return 1;
}

static int ascending(const void *a, const void *b)
{
    return *(const uint32_t *)a < *(const uint32_t *)b ? -1 : 1;
}

static uint32_t percentile(double share)
{
    long kept = sampled < SAMPLES ? sampled : SAMPLES;
    return kept ? samples_us[(long)(share * (kept - 1))] : 0;
}

static void sort_samples(void)
{
    qsort(samples_us, sampled < SAMPLES ? sampled : SAMPLES, sizeof *samples_us, ascending);
}

/* Returns 1 for an exception response, which is counted by its code. */
static int is_exception(const struct peer *p)
{
    if (!(p->answer[7] & 0x80)) return 0;
    exceptions[p->answer[8]]++;
    return 1;
}

static void print_exceptions(void)
{
    const char *comma = "";
    printf("\"exceptions\": {");
    for (int code = 0; code < 256; code++)
        if (exceptions[code]) {
            printf("%s\"%d\": %ld", comma, code, exceptions[code]);
            comma = ", ";
        }
    printf("}, ");
}

static void load(int port, int connections, int registers, double seconds)
{
    struct peer *peers = calloc(connections, sizeof *peers);
    struct epoll_event ready[256];
    long answers = 0, torn = 0, hung = 0;
    int poll = epoll_create1(0);
    for (int i = 0; i < connections; i++) {
        struct epoll_event e = {.events = EPOLLIN, .data.ptr = &peers[i]};
        peers[i].fd = connected(port);
        epoll_ctl(poll, EPOLL_CTL_ADD, peers[i].fd, &e);
    }
    int64_t start = now_ns(), end = start + (int64_t)(seconds * 1e9);
    for (int i = 0; i < connections; i++) ask(&peers[i], 3, 0, registers);
    while (now_ns() < end) {
        int n = epoll_wait(poll, ready, 256, 100);
        for (int i = 0; i < n; i++) {
            struct peer *p = ready[i].data.ptr;
            if (!receive(p)) continue;
            answers++;
            if (!is_exception(p))
                for (int k = 1; k < registers; k++)
                    if (memcmp(p->answer + 9, p->answer + 9 + 2 * k, 2)) {
                        torn++;
                        break;
                    }
            ask(p, 3, 0, registers);
        }
    }
    double elapsed = (now_ns() - start) / 1e9;
    for (int i = 0; i < connections; i++) hung += now_ns() - peers[i].sent_ns > 1000000000LL;
    sort_samples();
    printf("{\"requests\": %ld, \"seconds\": %.3f, \"torn\": %ld, \"hung\": %ld, ", answers,
           elapsed, torn, hung);
    print_exceptions();
    printf("\"p50_us\": %u, \"p99_us\": %u}\n", percentile(0.5), percentile(0.99));
}

static void write_registers(int port, int first, int registers, double seconds)
{
    struct peer p = {.fd = connected(port)};
    struct timeval second = {.tv_sec = 1};
    uint8_t r[13 + 2 * 123] = {0, 0, 0, 0, 0, 7 + 2 * registers, 1, 16,
                               first >> 8, first, 0, registers, 2 * registers};
    long answers = 0, hung = 0;
    int64_t start = now_ns(), end = start + (int64_t)(seconds * 1e9);
    setsockopt(p.fd, SOL_SOCKET, SO_RCVTIMEO, &second, sizeof second);
    while (now_ns() < end) {
        p.transaction++;
        r[0] = p.transaction >> 8;
        r[1] = p.transaction;
        for (int i = 0; i < registers; i++) memcpy(r + 13 + 2 * i, r, 2);
        p.sent_ns = now_ns();
        if (write(p.fd, r, 13 + 2 * registers) != 13 + 2 * registers) fail("write");
        int answered;
        while (!(answered = receive(&p)) && now_ns() < end) {}
        hung += now_ns() - p.sent_ns > 1000000000LL;
        if (!answered) break;
        answers++;
        is_exception(&p);
    }
    sort_samples();
    printf("{\"requests\": %ld, \"seconds\": %.3f, \"hung\": %ld, ", answers,
           (now_ns() - start) / 1e9, hung);
    print_exceptions();
    printf("\"p50_us\": %u, \"p99_us\": %u}\n", percentile(0.5), percentile(0.99));
}

static void echo(int port, double seconds)
{
    struct peer p = {.fd = connected(port)};
    static uint32_t loops_us[1 << 20];
    long loops = 0;
    int64_t end = now_ns() + (int64_t)(seconds * 1e9);
    for (uint16_t value = 1; now_ns() < end && loops < 1 << 20; value++) {
        int64_t start = now_ns();
        ask(&p, 6, 0, value);
        while (!receive(&p)) {}
        do {
            ask(&p, 3, 1, 1);
            while (!receive(&p)) {}
        } while ((p.answer[9] << 8 | p.answer[10]) != value);
        loops_us[loops++] = (now_ns() - start) / 1000;
        /* so that writes come at any phase of the cycle */
        struct timespec pause = {0, 100000 + rand() % 1000000};
        nanosleep(&pause, NULL);
    }
    memcpy(samples_us, loops_us, loops * sizeof *loops_us);
    sampled = loops;
    sort_samples();
    printf("{\"loops\": %ld, \"p50_us\": %u, \"p99_us\": %u}\n", loops, percentile(0.5),
           percentile(0.99));
}

int main(int argc, char **argv)
{
    if (argc == 6 && !strcmp(argv[1], "load"))
        load(atoi(argv[2]), atoi(argv[3]), atoi(argv[4]), atof(argv[5]));
    else if (argc == 6 && !strcmp(argv[1], "write"))
        write_registers(atoi(argv[2]), atoi(argv[3]), atoi(argv[4]), atof(argv[5]));
    else if (argc == 4 && !strcmp(argv[1], "echo"))
        echo(atoi(argv[2]), atof(argv[3]));
    else
        return 2;
    return 0;
}
