/* Options of an argument vector: those of one character, by getopt of unistd.h. */

#ifndef PLCSIM_GETOPT_H
#define PLCSIM_GETOPT_H

#include <unistd.h>

#endif
