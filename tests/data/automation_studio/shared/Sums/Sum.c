
#include <bur/plctypes.h>
#include "sums.h"

void Sum(struct Sum *inst)
{
	inst->total += inst->step;
}
