/* Mathematics (ISO C99 7.12). Results are the same on every machine. */

#ifndef PLCSIM_MATH_H
#define PLCSIM_MATH_H

#ifdef __cplusplus
extern "C" {
#endif

typedef float float_t;
typedef double double_t;

#define HUGE_VAL __builtin_inf()
#define HUGE_VALF __builtin_inff()
#undef INFINITY
#define INFINITY __builtin_inff()
#undef NAN
#define NAN __builtin_nanf("")

#define FP_NAN 0
#define FP_INFINITE 1
#define FP_ZERO 2
#define FP_SUBNORMAL 3
#define FP_NORMAL 4

#define FP_ILOGB0 (-0x7fffffff - 1)
#define FP_ILOGBNAN (-0x7fffffff - 1)
#define MATH_ERRNO 1
#define MATH_ERREXCEPT 2
#define math_errhandling 0

#ifndef __cplusplus
#define fpclassify(x) __builtin_fpclassify(FP_NAN, FP_INFINITE, FP_NORMAL, FP_SUBNORMAL, FP_ZERO, x)
#define isfinite(x) __builtin_isfinite(x)
#define isinf(x) __builtin_isinf(x)
#define isnan(x) __builtin_isnan(x)
#define isnormal(x) __builtin_isnormal(x)
#define signbit(x) (!!__builtin_signbit(x))
#endif

#define isgreater(x, y) __builtin_isgreater(x, y)
#define isgreaterequal(x, y) __builtin_isgreaterequal(x, y)
#define isless(x, y) __builtin_isless(x, y)
#define islessequal(x, y) __builtin_islessequal(x, y)
#define islessgreater(x, y) __builtin_islessgreater(x, y)
#define isunordered(x, y) __builtin_isunordered(x, y)

#define M_E 2.7182818284590452354
#define M_LOG2E 1.4426950408889634074
#define M_LOG10E 0.43429448190325182765
#define M_LN2 0.69314718055994530942
#define M_LN10 2.30258509299404568402
#define M_PI 3.14159265358979323846
#define M_TWOPI (M_PI * 2.0)
#define M_PI_2 1.57079632679489661923
#define M_PI_4 0.78539816339744830962
#define M_1_PI 0.31830988618379067154
#define M_2_PI 0.63661977236758134308
#define M_2_SQRTPI 1.12837916709551257390
#define M_SQRT2 1.41421356237309504880
#define M_SQRT1_2 0.70710678118654752440

double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);
double sinh(double x);
double cosh(double x);
double tanh(double x);
double asinh(double x);
double acosh(double x);
double atanh(double x);
double exp(double x);
double exp2(double x);
double expm1(double x);
double log(double x);
double log2(double x);
double log10(double x);
double log1p(double x);
double logb(double x);
int ilogb(double x);
double pow(double x, double y);
double sqrt(double x);
double cbrt(double x);
double hypot(double x, double y);
double erf(double x);
double erfc(double x);
double tgamma(double x);
double lgamma(double x);
double lgamma_r(double x, int *sign);
double floor(double x);
double ceil(double x);
double trunc(double x);
double round(double x);
double rint(double x);
double nearbyint(double x);
long lround(double x);
long lrint(double x);
long long llround(double x);
long long llrint(double x);
double fabs(double x);
double fmod(double x, double y);
double remainder(double x, double y);
double remquo(double x, double y, int *quotient);
double modf(double x, double *whole);
double frexp(double x, int *exponent);
double ldexp(double x, int exponent);
double scalbn(double x, int exponent);
double scalbln(double x, long exponent);
double copysign(double x, double y);
double nextafter(double x, double y);
double fdim(double x, double y);
double fmax(double x, double y);
double fmin(double x, double y);
double fma(double x, double y, double z);
double nan(const char *payload);

float sinf(float x);
float cosf(float x);
float tanf(float x);
float asinf(float x);
float acosf(float x);
float atanf(float x);
float atan2f(float y, float x);
float sinhf(float x);
float coshf(float x);
float tanhf(float x);
float asinhf(float x);
float acoshf(float x);
float atanhf(float x);
float expf(float x);
float exp2f(float x);
float expm1f(float x);
float logf(float x);
float log2f(float x);
float log10f(float x);
float log1pf(float x);
float logbf(float x);
int ilogbf(float x);
float powf(float x, float y);
float sqrtf(float x);
float cbrtf(float x);
float hypotf(float x, float y);
float erff(float x);
float erfcf(float x);
float tgammaf(float x);
float lgammaf(float x);
float floorf(float x);
float ceilf(float x);
float truncf(float x);
float roundf(float x);
float rintf(float x);
float nearbyintf(float x);
long lroundf(float x);
long lrintf(float x);
long long llroundf(float x);
long long llrintf(float x);
float fabsf(float x);
float fmodf(float x, float y);
float remainderf(float x, float y);
float modff(float x, float *whole);
float frexpf(float x, int *exponent);
float ldexpf(float x, int exponent);
float scalbnf(float x, int exponent);
float copysignf(float x, float y);
float nextafterf(float x, float y);
float fdimf(float x, float y);
float fmaxf(float x, float y);
float fminf(float x, float y);

/* long double is double, and so are its functions. */
long double acosl(long double x) __asm__("acos");
long double acoshl(long double x) __asm__("acosh");
long double asinl(long double x) __asm__("asin");
long double asinhl(long double x) __asm__("asinh");
long double atanl(long double x) __asm__("atan");
long double atanhl(long double x) __asm__("atanh");
long double cbrtl(long double x) __asm__("cbrt");
long double ceill(long double x) __asm__("ceil");
long double cosl(long double x) __asm__("cos");
long double coshl(long double x) __asm__("cosh");
long double erfl(long double x) __asm__("erf");
long double erfcl(long double x) __asm__("erfc");
long double expl(long double x) __asm__("exp");
long double exp2l(long double x) __asm__("exp2");
long double expm1l(long double x) __asm__("expm1");
long double fabsl(long double x) __asm__("fabs");
long double floorl(long double x) __asm__("floor");
long double lgammal(long double x) __asm__("lgamma");
long double logl(long double x) __asm__("log");
long double log10l(long double x) __asm__("log10");
long double log1pl(long double x) __asm__("log1p");
long double log2l(long double x) __asm__("log2");
long double logbl(long double x) __asm__("logb");
long double nearbyintl(long double x) __asm__("nearbyint");
long double rintl(long double x) __asm__("rint");
long double roundl(long double x) __asm__("round");
long double sinl(long double x) __asm__("sin");
long double sinhl(long double x) __asm__("sinh");
long double sqrtl(long double x) __asm__("sqrt");
long double tanl(long double x) __asm__("tan");
long double tanhl(long double x) __asm__("tanh");
long double tgammal(long double x) __asm__("tgamma");
long double truncl(long double x) __asm__("trunc");
long double atan2l(long double x, long double y) __asm__("atan2");
long double copysignl(long double x, long double y) __asm__("copysign");
long double fdiml(long double x, long double y) __asm__("fdim");
long double fmaxl(long double x, long double y) __asm__("fmax");
long double fminl(long double x, long double y) __asm__("fmin");
long double fmodl(long double x, long double y) __asm__("fmod");
long double hypotl(long double x, long double y) __asm__("hypot");
long double nextafterl(long double x, long double y) __asm__("nextafter");
long double powl(long double x, long double y) __asm__("pow");
long double remainderl(long double x, long double y) __asm__("remainder");
long double fmal(long double x, long double y, long double z) __asm__("fma");
long double modfl(long double x, long double *whole) __asm__("modf");
long double frexpl(long double x, int *exponent) __asm__("frexp");
long double ldexpl(long double x, int exponent) __asm__("ldexp");
long double scalbnl(long double x, int exponent) __asm__("scalbn");
int ilogbl(long double x) __asm__("ilogb");
long lroundl(long double x) __asm__("lround");
long lrintl(long double x) __asm__("lrint");
long long llroundl(long double x) __asm__("llround");
long long llrintl(long double x) __asm__("llrint");

#ifdef __cplusplus
}
#endif

#endif
