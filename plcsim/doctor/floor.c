/* The floor: the least that a loop on an absolute grid can be late on this host.
 *
 * floor CYCLE_NS CYCLES PRIORITY CPU
 *
 * Sleeps until each grid point with clock_nanosleep(TIMER_ABSTIME) and notes how late it woke; it
 * does nothing else. Grid points that pass meanwhile are skipped and counted, as in plcsim.core.scan.
 * PRIORITY above 0 asks for the rights that plcsim.host.realtime takes: SCHED_FIFO, one CPU (-1: any),
 * locked memory, no deep sleep. Writes {"missed": N, "lateness_ns": [...]} to stdout; where
 * SCHED_FIFO is refused, writes why to stderr and ends with 1.
 */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <time.h>
#include <unistd.h>

static int64_t now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * INT64_C(1000000000) + now.tv_nsec;
}

static void sleep_until_ns(int64_t until_ns)
{
    struct timespec until = {until_ns / 1000000000, until_ns % 1000000000};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL) == EINTR)
        ;
}

static void stay_awake(void)
{
    int32_t latency_us = 0;
    int fd = open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC); /* held until the process ends */
    if (fd >= 0 && write(fd, &latency_us, sizeof latency_us) < 0)
        close(fd);
}

static int take_rights(int priority, int cpu)
{
    struct sched_param parameter = {.sched_priority = priority};
    if (sched_setscheduler(0, SCHED_FIFO, &parameter) != 0)
        return -1;
    if (cpu >= 0) {
        cpu_set_t chosen;
        CPU_ZERO(&chosen);
        CPU_SET(cpu, &chosen);
        sched_setaffinity(0, sizeof chosen, &chosen);
    }
    mlockall(MCL_CURRENT | MCL_FUTURE);
    stay_awake();
    return 0;
}

static int64_t run(int64_t cycle_ns, long cycles, int64_t *lateness_ns)
{
    int64_t missed = 0, release_ns = now_ns() + cycle_ns;
    for (long i = 0; i < cycles; i++) {
        sleep_until_ns(release_ns);
        lateness_ns[i] = now_ns() - release_ns;
        int64_t passed = (lateness_ns[i] + cycle_ns - 1) / cycle_ns;
        if (passed < 1)
            passed = 1;
        missed += passed - 1;
        release_ns += passed * cycle_ns;
    }
    return missed;
}

int main(int argc, char **argv)
{
    if (argc != 5) {
        fprintf(stderr, "usage: floor CYCLE_NS CYCLES PRIORITY CPU\n");
        return 2;
    }
    int64_t cycle_ns = atoll(argv[1]);
    long cycles = atol(argv[2]);
    int priority = atoi(argv[3]);
    prctl(PR_SET_TIMERSLACK, 1);
    if (priority > 0 && take_rights(priority, atoi(argv[4])) != 0) {
        fprintf(stderr, "SCHED_FIFO: %s\n", strerror(errno));
        return 1;
    }
    int64_t *lateness_ns = malloc((cycles + 1) * sizeof *lateness_ns);
    if (lateness_ns == NULL) {
        fprintf(stderr, "no memory for %ld cycles\n", cycles);
        return 1;
    }
    memset(lateness_ns, 1, (cycles + 1) * sizeof *lateness_ns); /* no page fault in the loop */
    int64_t missed = run(cycle_ns, cycles, lateness_ns);
    printf("{\"missed\": %lld, \"lateness_ns\": [", (long long)missed);
    for (long i = 0; i < cycles; i++)
        printf(i ? ", %lld" : "%lld", (long long)lateness_ns[i]);
    printf("]}\n");
    return 0;
}
