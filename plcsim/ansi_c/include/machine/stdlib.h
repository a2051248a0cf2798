/* What newlib's stdlib.h takes from the machine. */

#ifndef PLCSIM_MACHINE_STDLIB_H
#define PLCSIM_MACHINE_STDLIB_H

#define __RAND_MAX 0x7fffffff

#endif
