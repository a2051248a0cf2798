/* Types and marks of programs for the controller, for C that runs as WebAssembly in PLC memory.
 *
 * Sizes and alignments are those of the 32-bit Intel target: long, pointers and enumerations have 4
 * bytes, types of 8 bytes are aligned to 4. Automation Studio brings a file of this name of its own;
 * this one shares no text with it. */

#ifndef PLCSIM_PLCTYPES_H
#define PLCSIM_PLCTYPES_H

#ifdef __cplusplus
typedef bool plcbit;
#else
typedef unsigned char plcbit;
#endif

typedef signed char plcsint;
typedef unsigned char plcusint, plcbyte;
typedef signed short plcint;
typedef unsigned short plcuint, plcword;
typedef signed long plcdint;
typedef unsigned long plcudint, plcdword;
typedef signed long long plclint __attribute__((aligned(4)));
typedef unsigned long long plculint __attribute__((aligned(4)));
typedef unsigned long long plclword __attribute__((aligned(4)));
typedef float plcreal;
typedef double plclreal __attribute__((aligned(4)));
typedef signed long plctime;  /* milliseconds */
typedef unsigned long plctod; /* milliseconds since midnight */
typedef unsigned long plcdate, plcdt; /* seconds since 1970-01-01 */
typedef char plcstring;
typedef unsigned short plcwstring;

typedef plcbit BOOL;
typedef plcsint SINT;
typedef plcusint USINT;
typedef plcint INT;
typedef plcuint UINT;
typedef plcdint DINT;
typedef plcudint UDINT;
typedef plclint LINT;
typedef plculint ULINT;
typedef plcbyte BYTE;
typedef plcword WORD;
typedef plcdword DWORD;
typedef plclword LWORD;
typedef plcreal REAL;
typedef plclreal LREAL;
typedef plctime TIME;
typedef plctod TIME_OF_DAY, TOD;
typedef plcdate DATE;
typedef plcdt DATE_AND_TIME, DT;
typedef plcstring STRING;
typedef plcwstring WSTRING;

#if !defined(TRUE) && !defined(PLCSIM_OWN_TRUTH)
#define TRUE 1
#define FALSE 0
#endif

/* The units of a program. */
#define _INIT __attribute__((used, export_name("_INIT")))
#define _CYCLIC __attribute__((used, export_name("_CYCLIC")))
#define _EXIT __attribute__((used, export_name("_EXIT")))

/* Variables of the controller. Weak: all files of a program mean the same one by a name, and where
 * a .var declares it, it is that one. `used` tells global ones from local ones. */
#define _LOCAL __attribute__((weak))
#define _LOCAL_RETAIN _LOCAL __attribute__((btf_decl_tag("RETAIN"))) /* goes into the debug information */
#define _BUR_LOCAL _LOCAL
#define _BUR_LOCAL_RETAIN _LOCAL_RETAIN
#define _GLOBAL __attribute__((weak, used, btf_decl_tag("_GLOBAL")))
#define _GLOBAL_RETAIN _GLOBAL __attribute__((btf_decl_tag("RETAIN")))
#define _GLOBAL_CONST extern const
#define _LOCAL_CONST static const
#define _IEC_CONST const

#define _BUR_PUBLIC __attribute__((visibility("default")))
#define _WEAK __attribute__((weak))

#endif
