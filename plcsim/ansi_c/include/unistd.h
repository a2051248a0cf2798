/* What programs use of POSIX. A controller has one process, and its units never wait. */

#ifndef PLCSIM_UNISTD_H
#define PLCSIM_UNISTD_H

#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

#define F_OK 0
#define X_OK 1
#define W_OK 2
#define R_OK 4
#define STDIN_FILENO 0
#define STDOUT_FILENO 1
#define STDERR_FILENO 2

int access(const char *path, int mode); /* of a file */
int unlink(const char *path);
pid_t getpid(void);
pid_t getppid(void);
int isatty(int file);
int gethostname(char *name, size_t size);
char *getcwd(char *path, size_t size); /* "", the first device */

/* Faults: what waits is written as states that go on in the next cycle. */
unsigned sleep(unsigned seconds);
int usleep(useconds_t microseconds);
void _exit(int status) __attribute__((noreturn));

#ifdef __cplusplus
}
#endif

#endif
