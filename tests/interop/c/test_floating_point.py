"""Arithmetic of REAL and LREAL in a unit gives the bits that gcc -m32 -mfpmath=sse gives."""

import pytest

SETS = 20_000
KINDS = 18
TEXT = f"""
#include <string.h>
#define SETS {SETS}
typedef unsigned long long u64;

static u64 state;
static unsigned next(void)
{{
	state = state * 6364136223846793005ULL + 1442695040888963407ULL;
	return (unsigned)(state >> 32);
}}
/* operands of every size: half of them any bits, half of them near 1 */
static float real(void)
{{
	unsigned bits = next();
	float value;
	if (next() & 1)
		bits = (bits & 0x807fffffu) | (0x3f800000u + ((bits >> 8 & 7) << 23));
	memcpy(&value, &bits, 4);
	return value;
}}
static double lreal(void)
{{
	u64 bits = (u64)next() << 32 | next();
	double value;
	if (next() & 1)
		bits = (bits & 0x800fffffffffffffULL) | (0x3ff0000000000000ULL + ((bits >> 40 & 7) << 52));
	memcpy(&value, &bits, 8);
	return value;
}}
static unsigned mix(unsigned hash, const void *value, unsigned size)
{{
	for (unsigned i = 0; i < size; i++)
		hash = (hash ^ ((const unsigned char *)value)[i]) * 16777619u;
	return hash;
}}
/* one pattern for all that is no number: which one an operation gives is left open */
static unsigned of_real(unsigned hash, volatile float value)
{{
	float kept = value;
	unsigned nan = 0x7fc00000u;
	return kept != kept ? mix(hash, &nan, 4) : mix(hash, &kept, 4);
}}
static unsigned of_lreal(unsigned hash, volatile double value)
{{
	double kept = value;
	u64 nan = 0x7ff8000000000000ULL;
	return kept != kept ? mix(hash, &nan, 8) : mix(hash, &kept, 8);
}}
static unsigned of_whole(unsigned hash, int value) {{ return mix(hash, &value, 4); }}
static int whole_of(double value) {{ return value > -2e9 && value < 2e9 ? (int)value : 0; }}

void fill(unsigned *to)
{{
	state = 42;
	for (int k = 0; k < {KINDS}; k++)
		to[k] = 2166136261u;
	for (int i = 0; i < SETS; i++) {{
		volatile float a = real(), b = real();
		volatile double c = lreal(), d = lreal();
		int n = (int)next();
		u64 m = (u64)next() << 32 | next();
		to[0] = of_real(to[0], a + b);
		to[1] = of_real(to[1], a - b);
		to[2] = of_real(to[2], a * b);
		to[3] = of_real(to[3], a / b);
		to[4] = of_lreal(to[4], c + d);
		to[5] = of_lreal(to[5], c - d);
		to[6] = of_lreal(to[6], c * d);
		to[7] = of_lreal(to[7], c / d);
		to[8] = of_real(to[8], (float)c);
		to[9] = of_lreal(to[9], (double)a);
		to[10] = of_real(to[10], (float)n);
		to[11] = of_lreal(to[11], (double)n);
		to[12] = of_real(to[12], (float)(long long)m);
		to[13] = of_lreal(to[13], (double)m);
		to[14] = of_whole(to[14], whole_of(a));
		to[15] = of_whole(to[15], whole_of(c));
		to[16] = of_whole(to[16], (a < b) + 2 * (a <= b) + 4 * (c < d) + 8 * (c == c));
		to[17] = of_lreal(to[17], a * b + c * d - (double)n / 3.0);
	}}
}}
"""


@pytest.mark.parametrize("optimised", ["-O0", "-O2"])
def test_hashes_of_20_000_operands_are_equal(optimised, unit_results, host_results):
    host = host_results(TEXT, KINDS, optimised)
    assert unit_results(TEXT, KINDS) == host
