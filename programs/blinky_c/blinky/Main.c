/* Blinky: a lamp that changes every half second. */

#include <bur/plctypes.h>
#ifdef _DEFAULT_INCLUDES
	#include <AsDefault.h>
#endif

/* The calls start the timer in the same cycle. With timer.IN = !timer.Q, as one often sees it, every
 * half period would be two cycles too long. */
static void change_lamp(void)
{
	lamp = !lamp;
	changes++;
	timer.IN = 0;
	TON(&timer);
	timer.IN = 1;
	TON(&timer);
}

void _INIT ProgramInit(void)
{
	lamp = 0;
}

void _CYCLIC ProgramCyclic(void)
{
	timer.IN = 1;
	timer.PT = half_period;
	TON(&timer);
	if (timer.Q)
		change_lamp();
}

void _EXIT ProgramExit(void)
{
	lamp = 0;
}
