/* Memory on the heap of a program or library: every module of C has one of its own. */

#ifndef PLCSIM_HEAP_H
#define PLCSIM_HEAP_H

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PLC_HEAP_RANGES 26
#define PLC_HEAP_STEPS 16

/* The controller writes `area` and `size`, everything else being 0, and reads the next four. */
struct plc_heap {
	char *area;
	size_t size; /* bytes */
	size_t used; /* bytes in areas that were not freed */
	size_t most; /* that ever were */
	size_t count; /* of areas that were not freed */
	size_t refused; /* requests for which there was no room */
	unsigned ranges; /* a bit for each range of sizes that has free areas */
	unsigned steps[PLC_HEAP_RANGES]; /* a bit for each step in a range */
	struct plc_block *free[PLC_HEAP_RANGES][PLC_HEAP_STEPS];
};

/* malloc and its relations on a given heap; each program gets its own ones by these. */
void *plc_malloc(struct plc_heap *heap, size_t size);
void *plc_calloc(struct plc_heap *heap, size_t count, size_t size);
void *plc_realloc(struct plc_heap *heap, void *area, size_t size);
void plc_free(struct plc_heap *heap, void *area);
void *plc_aligned_alloc(struct plc_heap *heap, size_t alignment, size_t size);
void *plc_reallocarray(struct plc_heap *heap, void *area, size_t count, size_t size);
char *plc_strdup(struct plc_heap *heap, const char *text);
char *plc_strndup(struct plc_heap *heap, const char *text, size_t most);

int plc_vasprintf(struct plc_heap *heap, char **text, const char *format, va_list values);
long plc_getdelim(struct plc_heap *heap, char **text, size_t *size, int last, FILE *file);
long plc_getline(struct plc_heap *heap, char **text, size_t *size, FILE *file);

/* `new` and `delete` of C++: where there is no room, that is a fault. */
void *plc_new(struct plc_heap *heap, size_t size);
void plc_delete(struct plc_heap *heap, void *area, size_t size);

#ifdef __cplusplus
}
#endif

#endif
