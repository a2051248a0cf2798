/* What compiled C++ calls by itself. */

#include "host.h"

void __cxa_pure_virtual(void) __attribute__((noreturn));

void __cxa_pure_virtual(void) { plc_fault("a virtual function was called that is not there yet"); }
