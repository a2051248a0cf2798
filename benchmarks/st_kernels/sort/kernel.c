enum { LAST = 999 };

void cyclic(void)
{
	for (v.i = 0; v.i <= LAST; v.i++) {
		v.seed = v.seed * 1103515245u + 12345u;
		v.numbers[v.i] = (short)(v.seed >> 16);
	}

	for (v.i = 0; v.i <= LAST - 1; v.i++) {
		for (v.j = 0; v.j <= LAST - 1 - v.i; v.j++) {
			if (v.numbers[v.j] > v.numbers[v.j + 1]) {
				v.kept = v.numbers[v.j];
				v.numbers[v.j] = v.numbers[v.j + 1];
				v.numbers[v.j + 1] = v.kept;
			}
		}
	}
}
