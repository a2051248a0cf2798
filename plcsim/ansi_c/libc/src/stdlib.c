/* Arithmetic, random numbers, searching, sorting, and the ends of a program. */

#include <stdlib.h>
#include <string.h>

#include "host.h"

int abs(int value) { return value < 0 ? -value : value; }
long labs(long value) { return value < 0 ? -value : value; }
long long llabs(long long value) { return value < 0 ? -value : value; }

div_t div(int number, int by) { return (div_t){number / by, number % by}; }
ldiv_t ldiv(long number, long by) { return (ldiv_t){number / by, number % by}; }
lldiv_t lldiv(long long number, long long by) { return (lldiv_t){number / by, number % by}; }

/* A linear congruence modulo 2^64 (Knuth, The Art of Computer Programming, volume 2, 3.3.4); its
 * upper half is used. */
static unsigned long long state = 1;

void srand(unsigned seed) { state = seed; }

int rand(void)
{
	state = state * 6364136223846793005ULL + 1;
	return (int)(state >> 32) & RAND_MAX;
}

int rand_r(unsigned *own)
{
	unsigned long long mixed = (*own + 1ULL) * 6364136223846793005ULL + 1;
	*own = (unsigned)(mixed >> 32);
	return (int)(*own & RAND_MAX);
}

typedef int comparison(const void *, const void *);

void *bsearch(const void *key, const void *area, size_t count, size_t size, comparison *compare)
{
	const char *first = area;
	while (count) {
		const char *middle = first + count / 2 * size;
		int order = compare(key, middle);
		if (!order)
			return (void *)middle;
		if (order > 0) {
			first = middle + size;
			count -= count / 2 + 1;
		} else {
			count /= 2;
		}
	}
	return 0;
}

static void exchange(char *a, char *b, size_t size)
{
	for (; size >= 4; size -= 4, a += 4, b += 4) {
		unsigned kept;
		memcpy(&kept, a, 4);
		memcpy(a, b, 4);
		memcpy(b, &kept, 4);
	}
	for (; size; size--, a++, b++) {
		char kept = *a;
		*a = *b;
		*b = kept;
	}
}

static void sink(char *area, size_t root, size_t count, size_t size, comparison *compare)
{
	for (size_t child; (child = 2 * root + 1) < count; root = child) {
		if (child + 1 < count && compare(area + child * size, area + (child + 1) * size) < 0)
			child++;
		if (compare(area + root * size, area + child * size) >= 0)
			return;
		exchange(area + root * size, area + child * size, size);
	}
}

/* A heap sort: it needs no memory, and no order of the elements makes it slow. */
void qsort(void *area, size_t count, size_t size, comparison *compare)
{
	char *first = area;
	for (size_t root = count / 2; root--;)
		sink(first, root, count, size, compare);
	while (count > 1) {
		count--;
		exchange(first, first + count * size, size);
		sink(first, 0, count, size, compare);
	}
}

void abort(void) { plc_fault("abort was called"); }

void exit(int status)
{
	plc_fault(status ? "exit was called with a status other than 0" : "exit was called");
}

char *getenv(const char *name) { return (void)name, (char *)0; }

long random(void) { return rand(); }
void srandom(unsigned seed) { srand(seed); }

char *utoa(unsigned value, char *text, int base)
{
	char digits[32];
	int count = 0, length = 0;
	if (base < 2 || base > 36)
		return *text = 0, text;
	do
		digits[count++] = "0123456789abcdefghijklmnopqrstuvwxyz"[value % (unsigned)base];
	while (value /= (unsigned)base);
	while (count)
		text[length++] = digits[--count];
	text[length] = 0;
	return text;
}

char *itoa(int value, char *text, int base)
{
	int is_negative = base == 10 && value < 0;
	*text = '-';
	utoa(is_negative ? 0u - (unsigned)value : (unsigned)value, text + is_negative, base);
	return text;
}
