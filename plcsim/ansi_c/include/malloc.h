/* Memory of the heap; see stdlib.h. */

#ifndef PLCSIM_MALLOC_H
#define PLCSIM_MALLOC_H

#include <stdlib.h>

#define memalign(alignment, size) aligned_alloc(alignment, size)

#endif
