/* Scheduling (POSIX): a program's units run to their end. */

#ifndef PLCSIM_SCHED_H
#define PLCSIM_SCHED_H

#ifdef __cplusplus
extern "C" {
#endif

int sched_yield(void); /* 0 */

#ifdef __cplusplus
}
#endif

#endif
