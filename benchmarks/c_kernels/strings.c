/* Frames of a text protocol: taken apart, checked, and put together again. */

static char frame[64] = "$12,-345,6789,ok*";
static char answer[64];

static int number(const char **at)
{
	int sign = 1, value = 0;
	if (**at == '-') {
		sign = -1;
		(*at)++;
	}
	while (**at >= '0' && **at <= '9')
		value = 10 * value + *(*at)++ - '0';
	return sign * value;
}

static char *put(char *to, int value)
{
	char digits[12];
	int count = 0;
	unsigned rest = value < 0 ? 0u - (unsigned)value : (unsigned)value;
	if (value < 0)
		*to++ = '-';
	do
		digits[count++] = (char)('0' + rest % 10);
	while (rest /= 10);
	while (count)
		*to++ = digits[--count];
	return to;
}

int run(int count)
{
	int sum = 0;
	for (int i = 0; i < count; i++) {
		const char *at = frame + 1;
		unsigned check = 0;
		char *to = answer;
		while (*at != '*')
			check ^= (unsigned char)*at++;
		at = frame + 1;
		while (*at != '*') {
			int value = number(&at);
			to = put(to, value + i % 7);
			*to++ = ';';
			while (*at != ',' && *at != '*')
				at++;
			if (*at == ',')
				at++;
		}
		*to = 0;
		frame[2] = (char)('0' + i % 10);
		sum += (int)check + answer[i % 8];
	}
	return sum;
}
