
#include <bur/plctypes.h>
#ifdef _DEFAULT_INCLUDES
	#include <AsDefault.h>
#endif
#include <string.h>

void _INIT ProgramInit(void)
{
	strcpy(text, "ready");
}

void _CYCLIC ProgramCyclic(void)
{
	cycles++;
}
