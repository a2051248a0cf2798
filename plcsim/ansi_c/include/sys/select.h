/* Sets of numbers; see sys/types.h. There is no select(): nothing waits. */

#include <sys/time.h>
