/* Folders on the file devices of the controller (POSIX); entries come in the order of their names. */

#ifndef PLCSIM_DIRENT_H
#define PLCSIM_DIRENT_H

#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

#define DT_UNKNOWN 0
#define DT_DIR 4
#define DT_REG 8

typedef struct plc_folder DIR;

struct dirent {
	ino_t d_ino;
	unsigned char d_type;
	char d_name[256];
};

DIR *opendir(const char *path);
struct dirent *readdir(DIR *folder);
void rewinddir(DIR *folder);
int closedir(DIR *folder);

#ifdef __cplusplus
}
#endif

#endif
