/* Signals (ISO C 7.14): a controller has none; a program that raises one ends as a fault. */

#ifndef PLCSIM_SIGNAL_H
#define PLCSIM_SIGNAL_H

#ifdef __cplusplus
extern "C" {
#endif

typedef int sig_atomic_t;

#define SIGHUP 1
#define SIGINT 2
#define SIGQUIT 3
#define SIGILL 4
#define SIGABRT 6
#define SIGFPE 8
#define SIGKILL 9
#define SIGSEGV 11
#define SIGPIPE 13
#define SIGALRM 14
#define SIGTERM 15
#define SIG_DFL ((void (*)(int))0)
#define SIG_IGN ((void (*)(int))1)
#define SIG_ERR ((void (*)(int))-1)

void (*signal(int number, void (*handler)(int)))(int); /* SIG_DFL; the handler is never called */
int raise(int number);

#ifdef __cplusplus
}
#endif

#endif
