/* The function blocks of the library standard: bistables, edges, counters and timers of
 * IEC 61131-3 (2.5.2.3), with the members that the controller's standard.fun gives them. The
 * structures are those data blocks; docs/compliance.md tells where the controller differs from the
 * norm. */

#include <stddef.h>
#include <stdint.h>

typedef unsigned char BOOL; /* any value but 0 is TRUE */

#define LAYOUT(type, member, offset, bytes) \
	_Static_assert(offsetof(type, member) == offset && sizeof(type) == bytes, #type)

/* The time of a cycle is its release, a cell of the system area (plcsim/core/system_area.py). */
#define RELEASE_NS (*(volatile const int64_t *)0x100008)

/* Bistables: S1 and R1 of the norm win. */

typedef struct { BOOL SET1, RESET, Q1; } SR;
typedef struct { BOOL SET, RESET1, Q1; } RS;
typedef struct { BOOL CLAIM, RELEASE, BUSY, X; } SEMA;

void iec_sr(SR *block) { block->Q1 = block->SET1 || (block->Q1 && !block->RESET); }

void iec_rs(RS *block) { block->Q1 = !block->RESET1 && (block->SET || block->Q1); }

void iec_sema(SEMA *block)
{
	block->BUSY = block->X != 0;
	if (block->CLAIM)
		block->X = 1;
	else if (block->RELEASE)
		block->BUSY = block->X = 0;
}

/* Edges: M is CLK at the last call and FALSE before the first one. So R_TRIG fires in its first
 * call where CLK is TRUE, as the norm notes, and F_TRIG never does. There the text of the norm
 * differs: it keeps NOT CLK, so that an F_TRIG whose CLK was never TRUE fires once after a restart.
 * We follow the controller: standard.fun wants a CLK that was TRUE in the last call, the code that
 * B&R's compiler makes of EDGENEG starts from FALSE likewise, and IEC 61131-8 advises to suppress
 * that edge. */

typedef struct { BOOL CLK, Q, M; } EDGE;

void iec_r_trig(EDGE *block)
{
	block->Q = block->CLK && !block->M;
	block->M = block->CLK != 0;
}

void iec_f_trig(EDGE *block)
{
	block->Q = block->M && !block->CLK;
	block->M = block->CLK != 0;
}

void iec_rf_trig(EDGE *block)
{
	block->Q = !block->CLK != !block->M;
	block->M = block->CLK != 0;
}

/* Counters: they count rising edges as R_TRIG finds them: an input that is TRUE in the first call
 * counts. CV stops at the ends of its type (PVmin and PVmax of the norm) and never wraps; at PV it
 * goes on. RESET and LOAD win over counting, and an edge that comes under them is lost. */

typedef struct { uint16_t PV, CV; BOOL CU, RESET, Q, M; } CTU;
typedef struct { uint16_t PV, CV; BOOL CD, LOAD, Q, M; } CTD;
typedef struct { int16_t PV, CV; BOOL CU, CD, RESET, LOAD, QU, QD, MU, MD; } CTUD;
LAYOUT(CTU, M, 7, 8);
LAYOUT(CTD, M, 7, 8);
LAYOUT(CTUD, MD, 11, 12);

void iec_ctu(CTU *block)
{
	if (block->RESET)
		block->CV = 0;
	else if (block->CU && !block->M && block->CV < UINT16_MAX)
		block->CV++;
	block->M = block->CU != 0;
	block->Q = block->CV >= block->PV;
}

void iec_ctd(CTD *block)
{
	if (block->LOAD)
		block->CV = block->PV;
	else if (block->CD && !block->M && block->CV > 0)
		block->CV--;
	block->M = block->CD != 0;
	block->Q = block->CV == 0;
}

/* RESET wins over LOAD; edges of both CU and CD in one call cancel. */
void iec_ctud(CTUD *block)
{
	int value = block->CV + (block->CU && !block->MU) - (block->CD && !block->MD);
	if (block->RESET)
		value = 0;
	else if (block->LOAD)
		value = block->PV;
	block->CV = (int16_t)(value > INT16_MAX ? INT16_MAX : value < INT16_MIN ? INT16_MIN : value);
	block->MU = block->CU != 0;
	block->MD = block->CD != 0;
	block->QU = block->CV >= block->PV;
	block->QD = block->CV <= 0;
}

/* Timers: TON, TOF, TP in milliseconds, TON_10ms, TOF_10ms, TP_10ms in ticks of 10 ms. What the
 * norm leaves to the implementation, for all alike:
 * - PT may change while the timer runs and holds from that call on: a PT that is not above the
 *   time passed ends it at once. Once the timer has run out, a change of PT has no effect before
 *   the next start.
 * - A PT of 0 or less runs out in the call that starts it.
 * - A timer that runs out between two releases shows it at the second one, never early; ET is 0 in
 *   the call that starts it and PT, not more, when it has run out. */

#define NS_PER_MS 1000000
#define NS_PER_TICK 10000000

/* The two internals of the controller's data block hold one 64-bit count of nanoseconds, low word
 * first: 1 + the release of the start, 0 where there was none. Milliseconds in StartTime alone
 * would end a timer up to 1 ms early where releases are not whole milliseconds, and would wrap
 * after 2^32 ms. */
typedef struct {
	int32_t PT, ET;
	uint32_t StartTime, Restart;
	BOOL IN, Q, M;
} TIMER;
LAYOUT(TIMER, M, 18, 20);

static void start(TIMER *timer, int64_t when)
{
	timer->StartTime = (uint32_t)when;
	timer->Restart = (uint32_t)((uint64_t)when >> 32);
}

/* Sets ET, within 0 and PT; returns whether PT has passed. */
static int passed(TIMER *timer)
{
	int64_t when = (int64_t)((uint64_t)timer->Restart << 32 | timer->StartTime);
	int64_t elapsed = (1 + RELEASE_NS - when) / NS_PER_MS;
	if (elapsed > timer->PT)
		elapsed = timer->PT;
	timer->ET = elapsed > 0 ? (int32_t)elapsed : 0;
	return timer->ET >= timer->PT;
}

void iec_ton(TIMER *timer)
{
	if (!timer->IN) {
		timer->M = timer->Q = 0;
		timer->ET = 0;
		return;
	}
	if (!timer->M) {
		timer->M = 1;
		start(timer, 1 + RELEASE_NS);
	}
	if (!timer->Q)
		timer->Q = passed(timer);
}

void iec_tof(TIMER *timer)
{
	if (timer->IN) {
		timer->M = timer->Q = 1;
		timer->ET = 0;
		return;
	}
	if (timer->M) {
		timer->M = 0;
		start(timer, 1 + RELEASE_NS);
	}
	if (timer->Q)
		timer->Q = !passed(timer);
}

/* IN has no effect during the pulse; ET stays at PT after it while IN is TRUE, and IN must be
 * FALSE in one call before the next pulse. A TP has no M: that byte is none of its data block. */
void iec_tp(TIMER *timer)
{
	if (timer->IN && !(timer->StartTime || timer->Restart)) {
		start(timer, 1 + RELEASE_NS);
		timer->Q = 1;
	}
	if (timer->Q)
		timer->Q = !passed(timer);
	if (!timer->Q && !timer->IN) {
		start(timer, 0);
		timer->ET = 0;
	}
}

/* StartTime is 1 + the tick of the start, 0 where there was none; so there are 2^32 - 1 ticks. */
typedef struct {
	uint32_t PT, ET, StartTime;
	BOOL IN, Q, M;
} TICK_TIMER;
LAYOUT(TICK_TIMER, M, 14, 16);

static uint32_t tick(void) { return 1 + (uint32_t)(RELEASE_NS / NS_PER_TICK % UINT32_MAX); }

static int ticks_passed(TICK_TIMER *timer)
{
	uint32_t now = tick();
	uint32_t elapsed = now - timer->StartTime - (now < timer->StartTime); /* modulo 2^32 - 1 */
	timer->ET = elapsed < timer->PT ? elapsed : timer->PT;
	return timer->ET >= timer->PT;
}

void iec_ton_10ms(TICK_TIMER *timer)
{
	if (!timer->IN) {
		timer->M = timer->Q = 0;
		timer->ET = 0;
		return;
	}
	if (!timer->M) {
		timer->M = 1;
		timer->StartTime = tick();
	}
	if (!timer->Q)
		timer->Q = ticks_passed(timer);
}

void iec_tof_10ms(TICK_TIMER *timer)
{
	if (timer->IN) {
		timer->M = timer->Q = 1;
		timer->ET = 0;
		return;
	}
	if (timer->M) {
		timer->M = 0;
		timer->StartTime = tick();
	}
	if (timer->Q)
		timer->Q = !ticks_passed(timer);
}

void iec_tp_10ms(TICK_TIMER *timer)
{
	if (timer->IN && !timer->StartTime) {
		timer->StartTime = tick();
		timer->Q = 1;
	}
	if (timer->Q)
		timer->Q = !ticks_passed(timer);
	if (!timer->Q && !timer->IN) {
		timer->StartTime = 0;
		timer->ET = 0;
	}
}
