/* What Automation Studio's bur/plc.h declares besides is declared in plctypes.h here. */
#ifndef _BUR_PLC_H_
#define _BUR_PLC_H_
#include <bur/plctypes.h>
#endif
