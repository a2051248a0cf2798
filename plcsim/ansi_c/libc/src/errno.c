/* Error numbers and what they mean. */

#include <errno.h>
#include <string.h>

#include "host.h"

int errno;

static const struct {
	int number;
	const char *text;
} texts[] = {
	{0, "no error"},
	{EPERM, "not permitted"},
	{ENOENT, "no such file or folder"},
	{EINTR, "interrupted"},
	{EIO, "input or output failed"},
	{EBADF, "no such open file"},
	{EAGAIN, "not possible now"},
	{ENOMEM, "out of memory"},
	{EACCES, "no access"},
	{EFAULT, "bad address"},
	{EBUSY, "in use"},
	{EEXIST, "exists already"},
	{ENODEV, "no such device"},
	{ENOTDIR, "not a folder"},
	{EISDIR, "a folder"},
	{EINVAL, "bad argument"},
	{ENFILE, "too many open files in the system"},
	{EMFILE, "too many open files"},
	{ENOSPC, "no space left"},
	{EPIPE, "the other end is closed"},
	{EDOM, "argument outside of the function's domain"},
	{ERANGE, "result too large or too small"},
	{ENOSYS, "not there"},
	{ETIMEDOUT, "timed out"},
	{ECONNREFUSED, "connection refused"},
	{ECONNRESET, "connection reset"},
	{EINPROGRESS, "in progress"},
	{EALREADY, "in progress already"},
	{ENOTCONN, "not connected"},
	{EISCONN, "connected already"},
	{ENOTSUP, "not supported"},
	{ENXIO, "no such device or address"},
	{E2BIG, "too long"},
	{EXDEV, "on another device"},
	{EFBIG, "file too large"},
	{EROFS, "read-only"},
	{ENAMETOOLONG, "name too long"},
	{ENOTEMPTY, "folder not empty"},
	{EILSEQ, "no character"},
	{EOVERFLOW, "value too large for its type"},
};

char *strerror(int number)
{
	for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
		if (texts[i].number == number)
			return (char *)texts[i].text;
	return (char *)"unknown error";
}

int strerror_r(int number, char *text, size_t size)
{
	return strlcpy(text, strerror(number), size) < size ? 0 : ERANGE;
}

void plc_assert(const char *text) __attribute__((noreturn));

void plc_assert(const char *text) { plc_fault(text); }
