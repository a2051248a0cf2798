/* Mathematics beside what comes from musl: what WebAssembly has an instruction for, and functions
 * for `float`, which are those for `double`, rounded once more. */

#include <math.h>

double __lgamma_r(double x, int *sign);

double sqrt(double x) { return __builtin_sqrt(x); }
double floor(double x) { return __builtin_floor(x); }
double ceil(double x) { return __builtin_ceil(x); }
double trunc(double x) { return __builtin_trunc(x); }
double rint(double x) { return __builtin_rint(x); }
double nearbyint(double x) { return __builtin_rint(x); }
double fabs(double x) { return __builtin_fabs(x); }
double copysign(double x, double y) { return __builtin_copysign(x, y); }

float sqrtf(float x) { return __builtin_sqrtf(x); }
float floorf(float x) { return __builtin_floorf(x); }
float ceilf(float x) { return __builtin_ceilf(x); }
float truncf(float x) { return __builtin_truncf(x); }
float rintf(float x) { return __builtin_rintf(x); }
float nearbyintf(float x) { return __builtin_rintf(x); }
float fabsf(float x) { return __builtin_fabsf(x); }
float copysignf(float x, float y) { return __builtin_copysignf(x, y); }

double ldexp(double x, int exponent) { return scalbn(x, exponent); }
double lgamma_r(double x, int *sign) { return __lgamma_r(x, sign); }
double nan(const char *payload) { return (void)payload, __builtin_nan(""); }

double lgamma(double x)
{
	int sign;
	return __lgamma_r(x, &sign);
}

double remainder(double x, double y)
{
	int quotient;
	return remquo(x, y, &quotient);
}

double modf(double x, double *whole)
{
	*whole = __builtin_trunc(x);
	return __builtin_copysign(isinf(x) ? 0.0 : x - *whole, x);
}

double fdim(double x, double y)
{
	if (isnan(x) || isnan(y))
		return x + y;
	return x > y ? x - y : 0;
}

double fmax(double x, double y)
{
	if (isnan(x))
		return y;
	if (x == y)
		return signbit(x) ? y : x;
	return x < y ? y : x;
}

double fmin(double x, double y)
{
	if (isnan(x))
		return y;
	if (x == y)
		return signbit(x) ? x : y;
	return y < x ? y : x;
}

/* What does not fit gives the smallest number, as the processor's own instruction does. */

long lrint(double x)
{
	x = __builtin_rint(x);
	return x >= -0x1p31 && x < 0x1p31 ? (long)x : -0x7fffffffL - 1;
}

long long llrint(double x)
{
	x = __builtin_rint(x);
	return x >= -0x1p63 && x < 0x1p63 ? (long long)x : -0x7fffffffffffffffLL - 1;
}

long lround(double x) { return lrint(round(x)); }
long long llround(double x) { return llrint(round(x)); }

#define OF_ONE(name) float name##f(float x) { return (float)name(x); }
#define OF_TWO(name) float name##f(float x, float y) { return (float)name(x, y); }
#define TO_INTEGER(type, name) type name##f(float x) { return name(x); }

OF_ONE(sin)
OF_ONE(cos)
OF_ONE(tan)
OF_ONE(asin)
OF_ONE(acos)
OF_ONE(atan)
OF_ONE(sinh)
OF_ONE(cosh)
OF_ONE(tanh)
OF_ONE(asinh)
OF_ONE(acosh)
OF_ONE(atanh)
OF_ONE(exp)
OF_ONE(exp2)
OF_ONE(expm1)
OF_ONE(log)
OF_ONE(log2)
OF_ONE(log10)
OF_ONE(log1p)
OF_ONE(logb)
OF_ONE(cbrt)
OF_ONE(erf)
OF_ONE(erfc)
OF_ONE(tgamma)
OF_ONE(lgamma)
OF_TWO(atan2)
OF_TWO(pow)
OF_TWO(hypot)
OF_TWO(fmod)
OF_TWO(remainder)
OF_TWO(fdim)
OF_TWO(fmax)
OF_TWO(fmin)
TO_INTEGER(int, ilogb)
TO_INTEGER(long, lrint)
TO_INTEGER(long, lround)
TO_INTEGER(long long, llrint)
TO_INTEGER(long long, llround)

float frexpf(float x, int *exponent) { return (float)frexp(x, exponent); }
float scalbnf(float x, int exponent) { return (float)scalbn(x, exponent); }
float ldexpf(float x, int exponent) { return (float)scalbn(x, exponent); }

float modff(float x, float *whole)
{
	double part, rest = modf(x, &part);
	*whole = (float)part;
	return (float)rest;
}
