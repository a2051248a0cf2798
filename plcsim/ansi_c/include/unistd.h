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
int rmdir(const char *path);
int chdir(const char *path); /* ENOSYS */
int close(int file); /* of fcntl.h, as what follows */
ssize_t read(int file, void *area, size_t count);
ssize_t write(int file, const void *area, size_t count); /* of stdout and stderr, too */
off_t lseek(int file, off_t offset, int origin);
int fsync(int file);
int dup(int file); /* ENOSYS, as the next three */
int dup2(int file, int other);
int pipe(int files[2]);
pid_t fork(void);
pid_t getpid(void);
pid_t getppid(void);
uid_t getuid(void); /* 0, as the next three */
uid_t geteuid(void);
gid_t getgid(void);
gid_t getegid(void);
int isatty(int file);
int gethostname(char *name, size_t size);
char *getcwd(char *path, size_t size); /* "", the first device */

/* Options of an argument vector, short ones (POSIX). */
extern char *optarg;
extern int optind, opterr, optopt;
int getopt(int count, char *const arguments[], const char *options);

unsigned alarm(unsigned seconds); /* 0: there are no signals */
long sysconf(int name); /* -1 */

#define SEEK_SET 0
#define SEEK_CUR 1
#define SEEK_END 2
#define _SC_PAGESIZE 1
#define _SC_NPROCESSORS_ONLN 2
#define _SC_CLK_TCK 3

/* 0 of them is no waiting. More are faults: what waits is written as states that go on in the next cycle. */
unsigned sleep(unsigned seconds);
int usleep(useconds_t microseconds);
void _exit(int status) __attribute__((__noreturn__));

#ifdef __cplusplus
}
#endif

#endif
