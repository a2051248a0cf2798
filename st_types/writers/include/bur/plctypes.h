/* Types of IEC 61131-3 in C, for headers that `plcsim types header` writes, on a host without
 * Automation Studio. Sizes as on the 32-bit target; compile with -m32.
 * Automation Studio brings a file of this name of its own; this one shares no text with it. */

#ifndef PLCSIM_PLCTYPES_H
#define PLCSIM_PLCTYPES_H

#ifdef __cplusplus
typedef bool plcbit;
#else
typedef unsigned char plcbit;
#endif

typedef signed char plcsint, SINT;
typedef unsigned char plcusint, plcbyte, USINT, BYTE;
typedef signed short plcint, INT;
typedef unsigned short plcuint, plcword, UINT, WORD;
typedef signed int plcdint, DINT;
typedef unsigned int plcudint, plcdword, UDINT, DWORD;
typedef signed long long plclint, LINT;
typedef unsigned long long plculint, plclword, ULINT, LWORD;
typedef float plcreal, REAL;
typedef double plclreal, LREAL;
typedef plcbit BOOL;

typedef signed int plctime, TIME;        /* milliseconds */
typedef unsigned int plctod, TIME_OF_DAY; /* milliseconds since midnight */
typedef unsigned int plcdate, DATE;      /* seconds since 1970-01-01 */
typedef unsigned int plcdt, DATE_AND_TIME; /* seconds since 1970-01-01 */
typedef char plcstring, STRING;
typedef unsigned short plcwstring, WSTRING;

/* Where Automation Studio places functions and variables; a host needs no such marks. */
#define _INIT
#define _CYCLIC
#define _EXIT
#define _LOCAL
#define _LOCAL_RETAIN
#define _LOCAL_CONST extern const
#define _BUR_LOCAL extern
#define _BUR_LOCAL_RETAIN extern
#define _GLOBAL extern
#define _GLOBAL_RETAIN extern
#define _GLOBAL_CONST extern const
#define _BUR_PUBLIC extern
#define _WEAK __attribute__((weak))

#endif
