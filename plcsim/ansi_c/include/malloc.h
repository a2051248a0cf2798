/* Memory of the heap; see stdlib.h. */

#include <stdlib.h>
