/* Files and folders by the functions of POSIX. */

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host.h"

#define FIRST 3 /* below are stdin, stdout and stderr */
#define MOST 64
#define MOST_FOLDERS 8

/* What open has opened, by the host's number. */
static struct {
	char is_open, appends;
	size_t place;
} files[MOST];

static int told(int result)
{
	if (result >= 0)
		return result;
	errno = -result;
	return -1;
}

static int done(int result) { return told(result) < 0 ? -1 : 0; }

static int number_of(int file)
{
	if (file >= FIRST && file < FIRST + MOST && files[file - FIRST].is_open)
		return file - FIRST;
	errno = EBADF;
	return -1;
}

int open(const char *path, int flags, ...)
{
	static const int accesses[] = {PLC_READ, PLC_WRITE, PLC_READ | PLC_WRITE, 0};
	int wanted = accesses[flags & 3];
	wanted |= flags & O_CREAT ? PLC_CREATE : 0;
	wanted |= flags & O_TRUNC ? PLC_TRUNCATE : 0;
	wanted |= flags & O_EXCL ? PLC_EXCLUSIVE : 0;
	int number = plc_file_open(path, wanted);
	if (number >= MOST) {
		plc_file_close(number);
		number = -EMFILE;
	}
	if (number < 0)
		return told(number);
	files[number].is_open = 1;
	files[number].appends = (flags & O_APPEND) != 0;
	files[number].place = 0;
	return FIRST + number;
}

int creat(const char *path, mode_t mode) { return open(path, O_WRONLY | O_CREAT | O_TRUNC, mode); }

int close(int file)
{
	int number = number_of(file);
	if (number < 0)
		return -1;
	files[number].is_open = 0;
	return told(plc_file_close(number));
}

ssize_t read(int file, void *area, size_t count)
{
	if (file == STDIN_FILENO)
		return 0;
	int number = number_of(file);
	if (number < 0)
		return -1;
	int done = plc_file_read(number, area, count, files[number].place);
	files[number].place += done > 0 ? (size_t)done : 0;
	return told(done);
}

ssize_t write(int file, const void *area, size_t count)
{
	if (file == STDOUT_FILENO || file == STDERR_FILENO)
		return plc_write(file, area, count), (ssize_t)count;
	int number = number_of(file);
	if (number < 0 || (files[number].appends && lseek(file, 0, SEEK_END) < 0))
		return -1;
	int done = plc_file_write(number, area, count, files[number].place);
	files[number].place += done > 0 ? (size_t)done : 0;
	return told(done);
}

off_t lseek(int file, off_t offset, int origin)
{
	int number = number_of(file);
	if (number < 0)
		return -1;
	long from = origin == SEEK_SET ? 0 : (long)files[number].place;
	if (origin == SEEK_END && (from = plc_file_size(number)) < 0)
		return told((int)from);
	if (origin < SEEK_SET || origin > SEEK_END || from + offset < 0)
		return told(-EINVAL);
	files[number].place = (size_t)(from + offset);
	return from + offset;
}

int fsync(int file) { return number_of(file) < 0 ? -1 : 0; }

int fcntl(int file, int command, ...)
{
	if (file > STDERR_FILENO && number_of(file) < 0)
		return -1;
	return command == F_GETFL || command == F_GETFD ? 0 : told(-EINVAL);
}

static void describe(const struct plc_entry *entry, struct stat *found)
{
	memset(found, 0, sizeof *found);
	found->st_mode = entry->is_folder ? S_IFDIR | S_IRWXU : S_IFREG | S_IRUSR | S_IWUSR;
	found->st_nlink = 1;
	found->st_size = (off_t)entry->size;
	found->st_blksize = BUFSIZ;
	found->st_blocks = (long)(entry->size + 511) / 512;
	found->st_atime = found->st_mtime = found->st_ctime = (time_t)entry->date;
}

int stat(const char *path, struct stat *found)
{
	struct plc_entry entry;
	int error = plc_entry_of(path, &entry);
	if (error >= 0)
		describe(&entry, found);
	return done(error);
}

int lstat(const char *path, struct stat *found) { return stat(path, found); }

int fstat(int file, struct stat *found)
{
	struct plc_entry entry = {0};
	if (file >= 0 && file < FIRST) {
		describe(&entry, found);
		found->st_mode = S_IFCHR | S_IRUSR | S_IWUSR;
		return 0;
	}
	int error = plc_entry_of_file(file - FIRST, &entry); /* those of fileno, too */
	if (error >= 0)
		describe(&entry, found);
	return done(error);
}

int mkdir(const char *path, mode_t mode) { return (void)mode, told(plc_folder_make(path)); }
int rmdir(const char *path) { return told(plc_folder_remove(path)); }

int chmod(const char *path, mode_t mode)
{
	struct plc_entry entry;
	return (void)mode, done(plc_entry_of(path, &entry));
}

mode_t umask(mode_t mask) { return (void)mask, 022; }

struct plc_folder {
	char is_open;
	int folder;
	struct dirent entry;
	char path[260];
};

static struct plc_folder folders[MOST_FOLDERS];

DIR *opendir(const char *path)
{
	for (DIR *free = folders; free < folders + MOST_FOLDERS; free++) {
		if (free->is_open)
			continue;
		int folder = plc_folder_open(path);
		if (folder < 0)
			return told(folder), (DIR *)0;
		strlcpy(free->path, path, sizeof free->path);
		free->folder = folder;
		free->is_open = 1;
		return free;
	}
	return told(-EMFILE), (DIR *)0;
}

static int is_folder(const DIR *folder)
{
	size_t at = (size_t)((const char *)folder - (const char *)folders);
	if (at < sizeof folders && at % sizeof *folders == 0 && folder->is_open)
		return 1;
	errno = EBADF;
	return 0;
}

struct dirent *readdir(DIR *folder)
{
	struct plc_entry entry;
	if (!is_folder(folder) || told(plc_folder_next(folder->folder, &entry)) <= 0)
		return 0;
	folder->entry.d_ino = 1;
	folder->entry.d_type = entry.is_folder ? DT_DIR : DT_REG;
	strlcpy(folder->entry.d_name, entry.name, sizeof folder->entry.d_name);
	return &folder->entry;
}

void rewinddir(DIR *folder)
{
	if (!is_folder(folder))
		return;
	plc_folder_close(folder->folder);
	folder->folder = plc_folder_open(folder->path);
}

int closedir(DIR *folder)
{
	if (!is_folder(folder))
		return -1;
	folder->is_open = 0;
	return told(plc_folder_close(folder->folder));
}

/* Cuts slashes off the end of a path, other than the one that it consists of. */
static size_t without_slashes(const char *path, size_t length)
{
	while (length > 1 && path[length - 1] == '/')
		length--;
	return length;
}

char *basename(char *path)
{
	if (!path || !*path)
		return (char *)".";
	path[without_slashes(path, strlen(path))] = 0;
	char *slash = strrchr(path, '/');
	return slash && slash[1] ? slash + 1 : path;
}

char *dirname(char *path)
{
	if (!path || !*path)
		return (char *)".";
	size_t length = without_slashes(path, strlen(path));
	while (length && path[length - 1] != '/')
		length--;
	if (!length)
		return (char *)".";
	path[without_slashes(path, length)] = 0;
	return path;
}

char *realpath(const char *path, char *real)
{
	struct plc_entry entry;
	if (!real || told(plc_entry_of(path, &entry)) < 0) {
		if (!real)
			errno = EINVAL;
		return 0;
	}
	return strlcpy(real, path, 260) < 260 ? real : 0;
}
