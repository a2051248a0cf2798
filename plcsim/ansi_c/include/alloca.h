/* Memory of the stack. */

#ifndef PLCSIM_ALLOCA_H
#define PLCSIM_ALLOCA_H

#define alloca(size) __builtin_alloca(size)

#endif
