/* What the headers of C++'s standard library (libc++) expect in a library: their templates for the
 * usual types, and the end of a program that breaks their rules. */

#include <__verbose_abort>
#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <functional>
#include <string>

extern "C" [[noreturn]] void plc_assert(const char *reason);

_LIBCPP_BEGIN_NAMESPACE_STD

template class basic_string<char>;
template string operator+(const char *, const string &);

/* Compare is __less of the type in all cases: ascending order. */
template <class Compare, class Place> void __sort(Place first, Place last, Compare)
{
	std::make_heap(first, last);
	std::sort_heap(first, last);
}

#define SORT(type) template void __sort<__less<type> &, type *>(type *, type *, __less<type> &);
SORT(char)
SORT(signed char)
SORT(unsigned char)
SORT(short)
SORT(unsigned short)
SORT(int)
SORT(unsigned)
SORT(long)
SORT(unsigned long)
SORT(long long)
SORT(unsigned long long)
SORT(float)
SORT(double)
SORT(long double)

void __libcpp_verbose_abort(const char *format, ...) noexcept
{
	static char text[300];
	va_list values;
	va_start(values, format);
	vsnprintf(text, sizeof text, format, values);
	va_end(values);
	plc_assert(text);
}

_LIBCPP_END_NAMESPACE_STD
