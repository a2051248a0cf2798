/* Exact decimal digits of floating-point numbers, for conversions in both directions.
 *
 * A double is mantissa x 2^e. For e < 0 that is (mantissa x 5^-e) / 10^-e, so in both cases its
 * digits are those of a whole number, computed in limbs of nine digits. In the other direction
 * an estimate is corrected until the number lies between the halves to its neighbours, which are
 * written exactly and compared digit by digit. */

#include "decimal.h"

#include <math.h>
#include <string.h>

#define LIMBS (DIGITS / 9 + 2)
#define BASE 1000000000u

typedef unsigned long long u64;

struct big {
	int used;
	unsigned limbs[LIMBS]; /* the lowest first */
};

/* The factor is less than BASE, so that what is carried over is one limb. */
static void multiply(struct big *number, unsigned factor)
{
	u64 carry = 0;
	for (int i = 0; i < number->used; i++) {
		carry += (u64)number->limbs[i] * factor;
		number->limbs[i] = (unsigned)(carry % BASE);
		carry /= BASE;
	}
	if (carry)
		number->limbs[number->used++] = (unsigned)carry;
}

static void multiply_by_power(struct big *number, unsigned base, int step, int exponent)
{
	unsigned factor = 1;
	for (int i = 0; i < step; i++)
		factor *= base;
	for (; exponent >= step; exponent -= step)
		multiply(number, factor);
	for (; exponent > 0; exponent--)
		multiply(number, base);
}

static void trim(struct decimal *number)
{
	while (number->length && !number->digits[number->length - 1])
		number->length--;
	if (!number->length)
		number->point = 0;
}

static void write_digits(const struct big *number, struct decimal *result)
{
	char *to = result->digits;
	for (int i = number->used - 1; i >= 0; i--) {
		unsigned limb = number->limbs[i];
		for (int digit = 8; digit >= 0; digit--, limb /= 10)
			to[digit] = (char)(limb % 10);
		to += 9;
	}
	int zeros = 0, count = (int)(to - result->digits);
	while (zeros < count && !result->digits[zeros])
		zeros++;
	memmove(result->digits, result->digits + zeros, (size_t)(count - zeros));
	result->length = count - zeros;
}

void decimal_of(u64 mantissa, int exponent, struct decimal *result)
{
	struct big number = {0, {0}};
	for (; mantissa && !(mantissa & 1) && exponent < 0; exponent++)
		mantissa >>= 1;
	for (; mantissa; mantissa /= BASE)
		number.limbs[number.used++] = (unsigned)(mantissa % BASE);
	if (exponent >= 0)
		multiply_by_power(&number, 2, 28, exponent);
	else
		multiply_by_power(&number, 5, 12, -exponent);
	write_digits(&number, result);
	result->point = result->length + (exponent < 0 ? exponent : 0);
	trim(result);
}

static void split(double value, u64 *mantissa, int *exponent)
{
	union { double value; u64 bits; } as = {value};
	int biased = (int)(as.bits >> 52) & 0x7FF;
	*mantissa = (as.bits & 0xFFFFFFFFFFFFFULL) | (biased ? 1ULL << 52 : 0);
	*exponent = (biased ? biased : 1) - 1075;
}

void decimal_of_double(double value, struct decimal *result)
{
	u64 mantissa;
	int exponent;
	split(value, &mantissa, &exponent);
	decimal_of(mantissa, exponent, result);
}

static int rounds_up(const struct decimal *number, int length)
{
	if (number->digits[length] != 5 || number->length > length + 1)
		return number->digits[length] >= 5;
	return length > 0 && number->digits[length - 1] & 1;
}

void decimal_round(struct decimal *number, int length)
{
	if (length >= number->length)
		return;
	int up = length >= 0 && rounds_up(number, length);
	number->length = length < 0 ? 0 : length;
	if (up) {
		int last = length - 1;
		while (last >= 0 && number->digits[last] == 9)
			last--;
		number->length = last + 1;
		if (last < 0) {
			number->digits[0] = 0;
			number->length = 1;
			number->point++;
			last = 0;
		}
		number->digits[last]++;
	}
	trim(number);
}

int decimal_compare(const struct decimal *a, const struct decimal *b)
{
	if (!a->length || !b->length)
		return !!a->length - !!b->length;
	if (a->point != b->point)
		return a->point < b->point ? -1 : 1;
	int shorter = a->length < b->length ? a->length : b->length;
	int order = memcmp(a->digits, b->digits, (size_t)shorter);
	if (!order)
		order = a->length - b->length;
	return (order > 0) - (order < 0);
}

static double power_of_ten(int exponent)
{
	static const double powers[] = {1e1, 1e2, 1e4, 1e8, 1e16, 1e32, 1e64, 1e128, 1e256};
	double result = 1;
	for (int i = 0; exponent; exponent >>= 1, i++)
		if (exponent & 1)
			result *= powers[i];
	return result;
}

/* Returns a number that is a few units in the last place off, or exact where that is easy. */
static double estimate(const struct decimal *number)
{
	double value = 0;
	int count = number->length < 17 ? number->length : 17;
	u64 first = 0;
	for (int i = 0; i < count; i++)
		first = 10 * first + (u64)number->digits[i];
	value = (double)first;
	int exponent = number->point - count;
	if (exponent > 0)
		return exponent > 308 ? INFINITY : value * power_of_ten(exponent);
	if (exponent < -290) { /* in two steps, neither of which loses what the other could keep */
		value /= 1e290;
		exponent += 290;
	}
	return value / power_of_ten(-exponent);
}

/* Writes what lies half way between a number and the next larger one; infinity follows the last. */
static void half_above(double value, struct decimal *result)
{
	u64 mantissa;
	int exponent;
	split(value, &mantissa, &exponent);
	decimal_of(2 * mantissa + 1, exponent - 1, result);
}

static double next(double value, int step)
{
	union { double value; long long bits; } as = {value};
	as.bits += step;
	return as.value;
}

static int is_odd(double value)
{
	union { double value; u64 bits; } as = {value};
	return (int)(as.bits & 1);
}

double decimal_to_double(const struct decimal *number)
{
	static const double largest = 0x1.fffffffffffffp1023;
	struct decimal half;
	if (!number->length || number->point < -330)
		return 0;
	if (number->point > 310)
		return INFINITY;
	double value = estimate(number);
	if (number->length <= 15 && value <= 1e22 && number->point - number->length >= -22)
		return value; /* both operands of the only operation were exact */
	if (isinf(value))
		value = largest;
	for (;;) {
		half_above(value, &half);
		int order = decimal_compare(number, &half);
		if (order < 0 || (!order && !is_odd(value)))
			break;
		value = value == largest ? INFINITY : next(value, 1);
		if (isinf(value) || !order)
			return value;
	}
	while (value > 0) {
		double lower = next(value, -1);
		half_above(lower, &half);
		int order = decimal_compare(number, &half);
		if (order > 0 || (!order && !is_odd(value)))
			break;
		value = lower;
	}
	return value;
}

float decimal_to_float(const struct decimal *number)
{
	struct decimal exact;
	double value = decimal_to_double(number);
	float nearest = (float)value;
	if ((double)nearest == value)
		return nearest;
	/* Rounded twice: right unless the double lay half way and the number did not. */
	float other = nextafterf(nearest, value > nearest ? INFINITY : -INFINITY);
	double middle = ((double)nearest + (double)other) / 2;
	if (isinf(nearest) || isinf(other) || value != middle)
		return nearest;
	decimal_of_double(value, &exact);
	int order = decimal_compare(number, &exact);
	if (!order)
		return nearest;
	return (order > 0) == (other > nearest) ? other : nearest;
}
