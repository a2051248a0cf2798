/* Nonlocal jumps. */

#ifndef _SETJMP_H
#define _SETJMP_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
	const void *__function; /* a call of the function that setjmp was called in */
	unsigned long __label;  /* which setjmp of it */
	unsigned long __call;
} jmp_buf[1];
typedef jmp_buf sigjmp_buf;

int setjmp(jmp_buf target) __attribute__((returns_twice));
void longjmp(jmp_buf target, int value) __attribute__((__noreturn__));

#define setjmp(target) setjmp(target)
#define _setjmp(target) setjmp(target)
#define _longjmp(target, value) longjmp(target, value)
#define sigsetjmp(target, savemask) setjmp(target)
#define siglongjmp(target, value) longjmp(target, value)

#ifdef __cplusplus
}
#endif

#endif
