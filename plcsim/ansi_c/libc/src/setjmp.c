/* Nonlocal jumps, as LLVM asks for them where a processor has none.
 *
 * A function that calls setjmp makes all its calls by the host's invoke_..., which come back with
 * __THREW__ set where longjmp has ended them. It then asks here whether the jump is meant for one
 * of its own calls of setjmp, and goes to the label behind that, or jumps on.
 *
 * Source: LLVM, WebAssemblyLowerEmscriptenEHSjLj.cpp, for what the functions are called and take. */

#include <setjmp.h>
#include <stddef.h>
#include <stdint.h>

#include "host.h"

uintptr_t __THREW__;
int __threwValue;

static const jmp_buf *jump;
static int second_result, is_passed_on;
static unsigned long calls;

int getTempRet0(void) { return second_result; }
void setTempRet0(int value) { second_result = value; }

void emscripten_longjmp(uintptr_t target, int value)
{
	jump = (const jmp_buf *)target;
	__THREW__ = target;
	__threwValue = value ? value : 1;
	int again = is_passed_on;
	is_passed_on = 0;
	plc_longjmp(again);
}

/* An exception of C++: static/cpp_exceptions.cpp keeps it. LLVM takes 1 for it, no jump is there. */
void plc_exception(const char *reason, int again)
{
	__THREW__ = 1;
	__threwValue = 0;
	plc_throw(reason, again);
}

/* Who gets 0 here calls emscripten_longjmp next. */
static unsigned long found(unsigned long label)
{
	is_passed_on = !label;
	return label;
}

/* LLVM 18 and newer: the address of a variable in a function stands for one call of it. */

void __wasm_setjmp(jmp_buf target, unsigned long label, const void *function)
{
	target->__function = function;
	target->__label = label;
}

unsigned long __wasm_setjmp_test(const jmp_buf target, const void *function)
{
	return found(target->__function == function ? target->__label : 0);
}

/* Older LLVM: so does an area from malloc, whose first word is 0 before the first setjmp. */

unsigned long *saveSetjmp(jmp_buf target, unsigned long label, unsigned long *function, int size)
{
	if (!*function)
		*function = ++calls; /* so that a later call with the same area is another one */
	target->__function = function;
	target->__label = label;
	target->__call = *function;
	second_result = size;
	return function;
}

unsigned long testSetjmp(unsigned long told, const unsigned long *function, int size)
{
	const jmp_buf *target = jump;
	(void)told, (void)size;
	int is_here = (*target)->__function == function && (*target)->__call == *function;
	return found(is_here ? (*target)->__label : 0);
}
