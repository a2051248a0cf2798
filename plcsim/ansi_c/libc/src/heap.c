/* A heap whose requests take the same short time however full it is: free areas stand in lists by
 * their size, in ranges of powers of two with 16 steps each, and bits tell which lists are not empty
 * (M. Masmano and others, TLSF: a new dynamic memory allocator for real-time systems, 2004).
 *
 * What a program does wrong with its memory is a fault: an area that is freed twice or is none, and
 * what was written behind the end of an area or into the beginning of a freed one, as soon as the
 * heap meets it. */

#include "heap.h"

#include <errno.h>
#include <stdint.h>
#include <string.h>

#include "host.h"

#define UNIT 8u /* areas are aligned to this and have a multiple of it */
#define SMALL 128u /* sizes below it have a list each */
#define FREE 1u

struct plc_block {
	size_t size; /* of the area, with FREE in its lowest bit */
	struct plc_block *before; /* the neighbour at the lower address */
	struct plc_block *next, *previous; /* in the list, of free blocks only */
};

#define HEAD offsetof(struct plc_block, next)

typedef struct plc_block block;

static const char damaged[] =
	"the heap is damaged: something was written behind the end of an area, or into a freed one";

static const char written_after_free[] = "something was written into an area of the heap that was freed";

#define MARKED 64u /* bytes at the beginning of a free area that are known */
#define MARK 0xF4EEF4EFu /* with FREE: heads of blocks may have lain there */

static size_t size_of(const block *b) { return b->size & ~FREE; }
static char *area_of(block *b) { return (char *)b + HEAD; }
static block *block_of(void *area) { return (block *)((char *)area - HEAD); }
static block *behind(const block *b) { return (block *)((char *)b + HEAD + size_of(b)); }

static unsigned highest(size_t number) { return 31u - (unsigned)__builtin_clz(number); }

static void find_list(size_t size, unsigned *range, unsigned *step)
{
	if (size < SMALL) {
		*range = 0;
		*step = size / UNIT;
		return;
	}
	unsigned power = highest(size);
	*range = power - 6;
	*step = size >> (power - 4) & (PLC_HEAP_STEPS - 1);
}

static unsigned long *mark(block *b) { return (unsigned long *)(b + 1); }

static unsigned long *end_of_marks(block *b)
{
	size_t size = size_of(b);
	return (unsigned long *)(area_of(b) + (size < MARKED ? size : MARKED));
}

static void enter(struct plc_heap *heap, block *b)
{
	unsigned range, step;
	find_list(size_of(b), &range, &step);
	block *first = heap->free[range][step];
	for (unsigned long *at = mark(b), *end = end_of_marks(b); at < end; at++)
		*at = MARK;
	b->size |= FREE;
	b->previous = 0;
	b->next = first;
	if (first)
		first->previous = b;
	heap->free[range][step] = b;
	heap->steps[range] |= 1u << step;
	heap->ranges |= 1u << range;
}

static int is_inside(const struct plc_heap *heap, const void *at)
{
	return (uintptr_t)at - (uintptr_t)heap->area < heap->size && (uintptr_t)at % UNIT == 0;
}

/* Ends the unit unless a block and its neighbours agree on what they are. */
static void check(const struct plc_heap *heap, const block *b)
{
	const block *other = behind(b);
	if (size_of(b) > heap->size || !is_inside(heap, other) || other->before != b)
		plc_fault(damaged);
}

static void leave(struct plc_heap *heap, block *b)
{
	unsigned range, step;
	check(heap, b);
	if (!(b->size & FREE) || (b->next && (!is_inside(heap, b->next) || b->next->previous != b)))
		plc_fault(damaged);
	for (unsigned long *at = mark(b), *end = end_of_marks(b); at < end; at++)
		if (*at != MARK)
			plc_fault(written_after_free);
	find_list(size_of(b), &range, &step);
	if (b->next)
		b->next->previous = b->previous;
	if (!b->previous)
		heap->free[range][step] = b->next;
	else if (is_inside(heap, b->previous) && b->previous->next == b)
		b->previous->next = b->next;
	else
		plc_fault(damaged);
	if (!heap->free[range][step] && !(heap->steps[range] &= ~(1u << step)))
		heap->ranges &= ~(1u << range);
	b->size &= ~FREE;
}

/* Makes one free area of the whole, between the heads of two blocks without an area. */
static void open_heap(struct plc_heap *heap)
{
	size_t lost = (UNIT - (uintptr_t)heap->area) % UNIT;
	heap->area += lost;
	heap->size = (heap->size - lost) & ~(UNIT - 1);
	block *first = (block *)heap->area;
	first->size = heap->size - 2 * HEAD;
	first->before = 0;
	block *end = behind(first);
	end->size = 0;
	end->before = first;
	enter(heap, first);
}

/* Gives what a block has beyond `size` back, where that is enough for a block. */
static void split(struct plc_heap *heap, block *b, size_t size)
{
	if (size_of(b) < size + sizeof(block))
		return;
	block *after = behind(b), *rest = (block *)(area_of(b) + size);
	rest->size = size_of(b) - size - HEAD;
	rest->before = b;
	b->size = size;
	if (after->size & FREE) {
		leave(heap, after);
		rest->size += HEAD + size_of(after);
		after = behind(rest);
	}
	after->before = rest;
	enter(heap, rest);
}

/* Returns a free block of at least a size: the first of the next list all of which are. */
static block *find(const struct plc_heap *heap, size_t size)
{
	unsigned range, step, set;
	size_t upper = size < SMALL ? size : size + (1u << (highest(size) - 4)) - 1;
	find_list(upper, &range, &step);
	set = range < PLC_HEAP_RANGES ? heap->steps[range] & ~0u << step : 0;
	if (!set) {
		unsigned larger = range + 1 < PLC_HEAP_RANGES ? heap->ranges & ~0u << (range + 1) : 0;
		if (larger) {
			range = (unsigned)__builtin_ctz(larger);
			set = heap->steps[range];
		}
	}
	if (set)
		return heap->free[range][__builtin_ctz(set)];
	find_list(size, &range, &step); /* the last chance: one of the same list that is large enough */
	block *b = heap->free[range][step];
	for (; b && size_of(b) < size; b = b->next)
		check(heap, b);
	return b;
}

static size_t rounded(size_t size)
{
	return size <= UNIT ? UNIT : (size + UNIT - 1) & ~(UNIT - 1);
}

static void count_use(struct plc_heap *heap, size_t before, size_t after)
{
	heap->used += after - before;
	if (heap->used > heap->most)
		heap->most = heap->used;
}

void *plc_malloc(struct plc_heap *heap, size_t size)
{
	if (!heap->count && !heap->ranges && heap->size > 2 * HEAD + 2 * UNIT)
		open_heap(heap);
	block *b = size < heap->size ? find(heap, rounded(size)) : 0;
	if (!b) {
		heap->refused++;
		return 0;
	}
	leave(heap, b);
	split(heap, b, rounded(size));
	heap->count++;
	count_use(heap, 0, size_of(b));
	return area_of(b);
}

/* Returns the block of an area that is in use. */
static block *block_in_use(struct plc_heap *heap, void *area)
{
	if (!is_inside(heap, area) || !is_inside(heap, block_of(area)))
		plc_fault("what is to be freed is no area of this program's heap");
	block *b = block_of(area);
	if (b->size & FREE)
		plc_fault("an area of the heap is freed that was freed before");
	check(heap, b);
	return b;
}

void plc_free(struct plc_heap *heap, void *area)
{
	if (!area)
		return;
	block *b = block_in_use(heap, area), *after = behind(b);
	heap->count--;
	count_use(heap, size_of(b), 0);
	if (after->size & FREE) {
		leave(heap, after);
		b->size += HEAD + size_of(after);
	}
	if (b->before && b->before->size & FREE) {
		block *before = b->before;
		leave(heap, before);
		b->size |= FREE; /* its head stays in the middle of an area: freed again, it is known */
		before->size += HEAD + size_of(b);
		b = before;
	}
	behind(b)->before = b;
	enter(heap, b);
}

void *plc_realloc(struct plc_heap *heap, void *area, size_t size)
{
	if (!area)
		return plc_malloc(heap, size);
	block *b = block_in_use(heap, area), *after = behind(b);
	size_t before = size_of(b);
	if (size < heap->size && after->size & FREE && before + HEAD + size_of(after) >= rounded(size)) {
		leave(heap, after);
		b->size += HEAD + size_of(after);
		behind(b)->before = b;
	}
	if (size < heap->size && size_of(b) >= rounded(size)) {
		split(heap, b, rounded(size));
		count_use(heap, before, size_of(b));
		return area;
	}
	void *moved = plc_malloc(heap, size);
	if (moved) {
		memcpy(moved, area, before);
		plc_free(heap, area);
	}
	return moved;
}

/* Takes an area that is larger, makes two of it where the second is aligned, and frees the first. */
void *plc_aligned_alloc(struct plc_heap *heap, size_t alignment, size_t size)
{
	if (!alignment || alignment & (alignment - 1)) {
		errno = EINVAL;
		return 0;
	}
	if (alignment <= UNIT)
		return plc_malloc(heap, size);
	size_t more = alignment + sizeof(block);
	if (alignment >= heap->size || size >= heap->size)
		more = heap->size; /* which is refused */
	char *area = plc_malloc(heap, size < heap->size ? rounded(size) + more : size);
	if (!area || !((uintptr_t)area & (alignment - 1)))
		return area ? plc_realloc(heap, area, size) : 0;
	char *aligned = (char *)(((uintptr_t)area + sizeof(block) + alignment - 1) & ~(alignment - 1));
	block *b = block_of(area), *second = block_of(aligned), *after = behind(b);
	second->size = size_of(b) - (size_t)(aligned - area);
	second->before = b;
	b->size = (size_t)((char *)second - area);
	after->before = second;
	heap->count++;
	count_use(heap, HEAD, 0);
	plc_free(heap, area);
	return plc_realloc(heap, aligned, size);
}

void *plc_reallocarray(struct plc_heap *heap, void *area, size_t count, size_t size)
{
	size_t all;
	if (__builtin_mul_overflow(count, size, &all)) {
		errno = ENOMEM;
		return 0;
	}
	return plc_realloc(heap, area, all);
}

void *plc_calloc(struct plc_heap *heap, size_t count, size_t size)
{
	size_t all;
	if (__builtin_mul_overflow(count, size, &all))
		all = (size_t)-1; /* which no heap has */
	void *area = plc_malloc(heap, all);
	return area ? memset(area, 0, all) : 0;
}

char *plc_strndup(struct plc_heap *heap, const char *text, size_t most)
{
	size_t length = strnlen(text, most);
	char *copy = plc_malloc(heap, length + 1);
	if (copy) {
		memcpy(copy, text, length);
		copy[length] = 0;
	}
	return copy;
}

char *plc_strdup(struct plc_heap *heap, const char *text)
{
	return plc_strndup(heap, text, (size_t)-1);
}

void *plc_new(struct plc_heap *heap, size_t size)
{
	void *area = plc_malloc(heap, size);
	if (!area)
		plc_fault("the heap has no room for what new asks for");
	return area;
}

void plc_delete(struct plc_heap *heap, void *area, size_t size)
{
	(void)size;
	plc_free(heap, area);
}
