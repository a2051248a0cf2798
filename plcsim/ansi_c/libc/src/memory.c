/* Copies, fills and comparisons of bytes.
 *
 * WebAssembly's own instructions for them are not used: they are carried out by the host, which
 * would end the process where compiled code traps. Words are read and written unaligned, which
 * WebAssembly allows. A fault in the middle leaves what came before it done. */

#include <string.h>

typedef unsigned char byte;
typedef unsigned long long word __attribute__((aligned(1), may_alias));

#define WORD sizeof(word)

static void copy_up(byte *to, const byte *from, size_t count)
{
	for (; count >= WORD; count -= WORD, to += WORD, from += WORD)
		*(word *)to = *(const word *)from;
	while (count--)
		*to++ = *from++;
}

static void copy_down(byte *to, const byte *from, size_t count)
{
	for (; count >= WORD; count -= WORD)
		*(word *)(to + count - WORD) = *(const word *)(from + count - WORD);
	while (count--)
		to[count] = from[count];
}

void *memmove(void *target, const void *source, size_t count)
{
	if ((size_t)target - (size_t)source >= count)
		copy_up(target, source, count);
	else
		copy_down(target, source, count);
	return target;
}

void *memcpy(void *target, const void *source, size_t count)
{
	copy_up(target, source, count);
	return target;
}

void *memset(void *target, int value, size_t count)
{
	byte *to = target;
	word pattern = (byte)value * 0x0101010101010101ULL;
	for (; count >= WORD; count -= WORD, to += WORD)
		*(word *)to = pattern;
	while (count--)
		*to++ = (byte)value;
	return target;
}

int memcmp(const void *a, const void *b, size_t count)
{
	const byte *left = a, *right = b;
	for (; count >= WORD && *(const word *)left == *(const word *)right; count -= WORD) {
		left += WORD;
		right += WORD;
	}
	for (; count; count--, left++, right++)
		if (*left != *right)
			return *left - *right;
	return 0;
}

void *memchr(const void *area, int value, size_t count)
{
	const byte *at = area;
	for (; count; count--, at++)
		if (*at == (byte)value)
			return (void *)at;
	return 0;
}

void *memrchr(const void *area, int value, size_t count)
{
	const byte *first = area;
	while (count--)
		if (first[count] == (byte)value)
			return (void *)(first + count);
	return 0;
}

void *mempcpy(void *target, const void *source, size_t count)
{
	return (byte *)memcpy(target, source, count) + count;
}

void *memccpy(void *target, const void *source, int last, size_t count)
{
	const byte *found = memchr(source, last, count);
	if (!found)
		return memcpy(target, source, count), (void *)0;
	return mempcpy(target, source, (size_t)(found - (const byte *)source) + 1);
}

void *memmem(const void *area, size_t size, const void *part, size_t length)
{
	const byte *at = area;
	for (; length <= size; at++, size--)
		if (!memcmp(at, part, length))
			return (void *)at;
	return 0;
}
