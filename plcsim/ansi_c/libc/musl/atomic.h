/* What fma.c takes from the processor's own instructions. */

#define a_clz_64(x) __builtin_clzll(x)
#define a_ctz_64(x) __builtin_ctzll(x)
