/* Words that the headers of newlib, the C library of the controller's compiler, are written with.
 * Projects bring copies of such headers, with some functions left out. */

#ifndef PLCSIM_ANSI_H
#define PLCSIM_ANSI_H

#ifdef __cplusplus
#define _BEGIN_STD_C extern "C" {
#define _END_STD_C }
#else
#define _BEGIN_STD_C
#define _END_STD_C
#endif

#define _AND ,
#define _ATTRIBUTE(attributes) __attribute__(attributes)
#define _CONST const
#define _EXFNPTR(name, parameters) (*name) parameters
#define _EXFUN(name, parameters) name parameters
#define _EXFUN_NOTHROW(name, parameters) name parameters
#define _EXPARM(name, parameters) (*name) parameters
#define _LONG_DOUBLE long double
#define _NOARGS void
#define _PARAMS(parameters) parameters
#define _PTR void *
#define _SIGNED signed
#define _VOID void
#define _VOLATILE volatile
#define __IMPORT

#endif
