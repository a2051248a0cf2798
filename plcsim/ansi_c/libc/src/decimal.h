/* Exact decimal digits of floating-point numbers, for conversions in both directions. */

#ifndef PLCSIM_DECIMAL_H
#define PLCSIM_DECIMAL_H

/* 767 are the most significant digits of any double, 770 of what lies between two of them. */
#define DIGITS 800

/* The number 0.d1 d2 d3 ... x 10^point; the first and the last digit are not 0, and zero has none. */
struct decimal {
	int length;
	int point;
	char digits[DIGITS]; /* 0 to 9, not characters */
};

#define hidden __attribute__((visibility("hidden")))

/* Writes `mantissa` x 2^`exponent`, without loss. */
hidden void decimal_of(unsigned long long mantissa, int exponent, struct decimal *result);

/* Writes the magnitude of a finite number, without loss. */
hidden void decimal_of_double(double value, struct decimal *result);

/* Rounds to `length` digits behind the point of the representation, ties to even; 0 and less are
 * possible. */
hidden void decimal_round(struct decimal *number, int length);

/* Returns -1, 0 or 1. */
hidden int decimal_compare(const struct decimal *a, const struct decimal *b);

/* Return the nearest number, ties to even; infinity where there is none. */
hidden double decimal_to_double(const struct decimal *number);
hidden float decimal_to_float(const struct decimal *number);

#endif
