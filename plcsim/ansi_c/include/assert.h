/* An assertion that does not hold ends the unit as a fault, with its text and line. */

#undef assert

#ifdef NDEBUG
#define assert(condition) ((void)0)
#else
#ifdef __cplusplus
extern "C" void plc_assert(const char *text) __attribute__((__noreturn__));
#else
void plc_assert(const char *text) __attribute__((__noreturn__));
#define static_assert _Static_assert
#endif
#define assert(condition) \
	((condition) ? (void)0 : plc_assert("assertion failed: " #condition))
#endif
