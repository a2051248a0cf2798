/* What musl's own header of this name gives to its sources. */

#define hidden __attribute__((visibility("hidden")))
#define weak_alias(old, new) extern __typeof__(old) new __attribute__((weak, alias(#old)))
