/* Options of an argument vector (POSIX getopt). */

#include <stdio.h>
#include <string.h>
#include <unistd.h>

char *optarg;
int optind = 1, opterr = 1, optopt;

static int place; /* in the argument that holds several options; 0 before its first */

static int wrong(const char *program, const char *options, const char *text)
{
	if (opterr && *options != ':')
		fprintf(stderr, "%s: %s -- %c\n", program, text, optopt);
	return '?';
}

int getopt(int count, char *const arguments[], const char *options)
{
	optarg = 0;
	if (!place) {
		const char *argument = optind < count ? arguments[optind] : 0;
		if (!argument || argument[0] != '-' || !argument[1])
			return -1;
		if (argument[1] == '-' && !argument[2])
			return optind++, -1;
		place = 1;
	}
	const char *argument = arguments[optind];
	optopt = argument[place++];
	const char *known = optopt == ':' ? 0 : strchr(options, optopt);
	int is_last = !argument[place];
	if (known && known[1] == ':' && !is_last)
		optarg = arguments[optind] + place;
	if (is_last || optarg) {
		optind++;
		place = 0;
	}
	if (!known)
		return wrong(arguments[0], options, "unknown option");
	if (known[1] != ':' || optarg)
		return optopt;
	if (optind < count) {
		optarg = arguments[optind++];
		return optopt;
	}
	return *options == ':' ? ':' : wrong(arguments[0], options, "option needs an argument");
}
