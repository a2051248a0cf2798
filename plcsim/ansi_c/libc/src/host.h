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

#ifdef __cplusplus
}
#endif

#endif
