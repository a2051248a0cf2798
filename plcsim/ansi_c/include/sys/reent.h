/* Types of the functions of newlib that take their state from the caller; there are none here. */

#ifndef PLCSIM_SYS_REENT_H
#define PLCSIM_SYS_REENT_H

#include <_ansi.h>
#include <stddef.h>

struct _reent;
typedef struct {
	int count;
	unsigned value;
} _mbstate_t;

#endif
