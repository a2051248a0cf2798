/* Headers of Automation Studio include those of C inside of extern "C", where C++ has templates. */
extern "C++" {
#include_next <errno.h>
}
