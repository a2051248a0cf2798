/* Bubble sort of 1000 INT that a linear congruence has made. */

static short values[1000];

int run(int count)
{
	unsigned state = 12345;
	int sum = 0;
	for (int i = 0; i < count; i++) {
		for (int k = 0; k < 1000; k++) {
			state = state * 1664525u + 1013904223u;
			values[k] = (short)(state >> 16);
		}
		for (int last = 999; last > 0; last--)
			for (int k = 0; k < last; k++)
				if (values[k] > values[k + 1]) {
					short kept = values[k];
					values[k] = values[k + 1];
					values[k + 1] = kept;
				}
		sum += values[i % 1000];
	}
	return sum;
}
