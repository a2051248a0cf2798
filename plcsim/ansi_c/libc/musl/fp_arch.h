/* WebAssembly rounds to nearest always and knows no floating-point exceptions: nothing has to be
 * computed for the sake of those. */

#include "features.h"

#define fp_barrierf(x) (x)
#define fp_barrier(x) (x)
#define fp_barrierl(x) (x)
#define fp_force_evalf(x) (void)(x)
#define fp_force_eval(x) (void)(x)
#define fp_force_evall(x) (void)(x)
