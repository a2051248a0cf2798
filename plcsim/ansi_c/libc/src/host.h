/* What the C library asks of the controller around it. */

#ifndef PLCSIM_HOST_H
#define PLCSIM_HOST_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes to standard output (1) or standard error (2) of the scan. */
void plc_write(int file, const char *text, size_t length);

/* Ends the unit as a fault with a reason. */
void plc_fault(const char *reason) __attribute__((noreturn));

/* Ends all calls up to the nearest one that was made by invoke_... ; again for a jump that has ended
 * there and goes on. */
void plc_longjmp(int again) __attribute__((noreturn));

/* Likewise for an exception of C++; reason for where there is no such call. */
void plc_throw(const char *reason, int again) __attribute__((noreturn));

/* Files, on the file devices of the controller. All return a number of errno.h, below 0, for what
 * they could not do. Places in a file are counted in bytes from its beginning. */

#define PLC_READ 1
#define PLC_WRITE 2
#define PLC_CREATE 4
#define PLC_TRUNCATE 8
#define PLC_EXCLUSIVE 16

int plc_file_open(const char *path, int flags); /* returns a number for the file, from 0 */
int plc_file_close(int file);
int plc_file_read(int file, void *area, size_t count, size_t place); /* returns bytes read */
int plc_file_write(int file, const void *area, size_t count, size_t place);
int plc_file_size(int file);
int plc_file_remove(const char *path);
int plc_file_rename(const char *from, const char *to);

struct plc_entry {
	unsigned is_folder;
	unsigned size;
	long long date; /* of the last change, in seconds since 1970-01-01 */
	char name[256];
};

int plc_entry_of(const char *path, struct plc_entry *entry); /* without its name */
int plc_entry_of_file(int file, struct plc_entry *entry);
int plc_folder_open(const char *path); /* returns a number for the folder, from 0 */
int plc_folder_next(int folder, struct plc_entry *entry); /* returns 0 behind the last one, else 1 */
int plc_folder_close(int folder);
int plc_folder_make(const char *path);
int plc_folder_remove(const char *path);

#ifdef __cplusplus
}
#endif

#endif
