/* What files and folders on the file devices of the controller are (POSIX). */

#ifndef PLCSIM_SYS_STAT_H
#define PLCSIM_SYS_STAT_H

#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

#define S_IFMT 0170000
#define S_IFDIR 0040000
#define S_IFCHR 0020000
#define S_IFREG 0100000
#define S_IRUSR 0400
#define S_IWUSR 0200
#define S_IXUSR 0100
#define S_IRWXU 0700
#define S_IRGRP 0040
#define S_IWGRP 0020
#define S_IXGRP 0010
#define S_IRWXG 0070
#define S_IROTH 0004
#define S_IWOTH 0002
#define S_IXOTH 0001
#define S_IRWXO 0007
#define S_ISDIR(mode) (((mode) & S_IFMT) == S_IFDIR)
#define S_ISREG(mode) (((mode) & S_IFMT) == S_IFREG)
#define S_ISCHR(mode) (((mode) & S_IFMT) == S_IFCHR)
#define S_ISLNK(mode) 0
#define S_ISFIFO(mode) 0
#define S_ISSOCK(mode) 0

struct stat {
	dev_t st_dev;
	ino_t st_ino;
	mode_t st_mode;
	nlink_t st_nlink;
	uid_t st_uid;
	gid_t st_gid;
	dev_t st_rdev;
	off_t st_size;
	time_t st_atime, st_mtime, st_ctime; /* all three the date of the last change */
	long st_blksize, st_blocks;
};

int stat(const char *path, struct stat *found);
int lstat(const char *path, struct stat *found);
int fstat(int file, struct stat *found);
int mkdir(const char *path, mode_t mode);
int chmod(const char *path, mode_t mode); /* changes nothing */
mode_t umask(mode_t mask);

#ifdef __cplusplus
}
#endif

#endif
