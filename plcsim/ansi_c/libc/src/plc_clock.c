/* What reads the controller's clock and date, or compares two dates: functions of the libraries
 * astime, sys_lib and AsIOTime that programs call in every cycle; and those of AsIODiag that tell
 * that the controller is simulated. */

#include <stddef.h>
#include <stdint.h>

/* Cells of the system area (plcsim/core/system_area.py); both stand still within a cycle. */
#define RELEASE_NS (*(volatile const int64_t *)0x100008)
#define DATE_NS (RELEASE_NS + *(volatile const int64_t *)0x100010)

#define NS_PER_SECOND 1000000000
#define NS_PER_TICK 10000000
#define NS_PER_MS 1000000
#define NS_PER_US 1000

#define ERR_FUB_ENABLE_FALSE 65534

/* Milliseconds as a TIME, microseconds as a DINT; both wrap after 2^32. */
int32_t plc_clock_ms(void) { return (int32_t)(uint32_t)(RELEASE_NS / NS_PER_MS); }
int32_t plc_cyclic_start(void) { return (int32_t)(uint32_t)(RELEASE_NS / NS_PER_US); }

/* Ticks of 10 ms in the second, and microseconds in the tick. */
uint32_t plc_ticks(void) { return (uint32_t)(DATE_NS / NS_PER_TICK % 100); }
uint32_t plc_musec(void) { return (uint32_t)(DATE_NS % NS_PER_TICK / NS_PER_US); }

/* Differences wrap below 0. */
uint32_t plc_diff_t(int32_t later, int32_t earlier) { return (uint32_t)later - (uint32_t)earlier; }
uint32_t plc_diff_dt(uint32_t later, uint32_t earlier) { return later - earlier; }

typedef struct {
	uint16_t status;
	uint32_t DT1;
	unsigned char enable;
} DTGetTime;
_Static_assert(offsetof(DTGetTime, enable) == 8 && sizeof(DTGetTime) == 12, "DTGetTime");

void plc_dt_get_time(DTGetTime *block)
{
	if (block->enable)
		block->DT1 = (uint32_t)(DATE_NS / NS_PER_SECOND);
	block->status = block->enable ? 0 : ERR_FUB_ENABLE_FALSE;
}

unsigned char plc_is_simulated(void) { return 1; }
