static void assign(char *target, const char *source, int limit)
{
	while (limit > 0 && *source) {
		*target++ = *source++;
		limit--;
	}
	*target = 0;
}

static int compare(const char *left, const char *right)
{
	while (*left && *left == *right) {
		left++;
		right++;
	}
	return (unsigned char)*left - (unsigned char)*right;
}

void cyclic(void)
{
	v.cycles = v.cycles + 1;
	assign(v.command, v.names[v.cycles % 8], 20);
	for (v.index = 0; v.index <= 7; v.index++) {
		if (compare(v.names[v.index], v.command) == 0) {
			v.matches = v.matches + v.index;
			break;
		}
	}
	if (compare(v.command, v.last) != 0) {
		assign(v.text, v.command, 80);
		assign(v.last, v.text, 20);
	}
	if (compare(v.command, "HALT") < 0) {
		v.matches = v.matches + 100;
	}
}
