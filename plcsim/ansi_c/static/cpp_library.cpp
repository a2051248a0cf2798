/* What the headers of C++'s standard library (libc++) expect in a library: their templates for the
 * usual types, and the end of a program that breaks their rules. */

#include <__verbose_abort>
#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <unordered_map>

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

static string text_of(const char *format, ...)
{
	char text[400]; /* the largest double has 309 digits before its point */
	va_list values;
	va_start(values, format);
	vsnprintf(text, sizeof text, format, values);
	va_end(values);
	return text;
}

#define TO_STRING(type, format) string to_string(type value) { return text_of(format, value); }
TO_STRING(int, "%d")
TO_STRING(unsigned, "%u")
TO_STRING(long, "%ld")
TO_STRING(unsigned long, "%lu")
TO_STRING(long long, "%lld")
TO_STRING(unsigned long long, "%llu")
TO_STRING(float, "%f")
TO_STRING(double, "%f")
TO_STRING(long double, "%Lf")

/* What `parse` makes of a text; `index` gets the number of characters that it has read. */
template <class Parse> static auto number_of(const string &text, size_t *index, Parse parse)
{
	char *end;
	auto value = parse(text.c_str(), &end);
	if (end == text.c_str())
		__throw_invalid_argument((text + " is no number").c_str());
	if (index)
		*index = end - text.c_str();
	return value;
}

#define TO_INTEGER(type, name, parse) \
	type name(const string &text, size_t *index, int base) \
	{ \
		auto value = number_of(text, index, [=](auto *from, auto **end) { return parse(from, end, base); }); \
		if (value != (type)value) \
			__throw_out_of_range((text + " is too large").c_str()); \
		return value; \
	}
TO_INTEGER(int, stoi, strtol)
TO_INTEGER(long, stol, strtol)
TO_INTEGER(unsigned long, stoul, strtoul)
TO_INTEGER(long long, stoll, strtoll)
TO_INTEGER(unsigned long long, stoull, strtoull)

#define TO_REAL(type, name, parse) \
	type name(const string &text, size_t *index) \
	{ \
		return number_of(text, index, [](auto *from, auto **end) { return parse(from, end); }); \
	}
TO_REAL(float, stof, strtof)
TO_REAL(double, stod, strtod)
TO_REAL(long double, stold, strtod)

/* The number of places of an unordered container: a prime, `least` or more. */
size_t __next_prime(size_t least)
{
	for (size_t number = least < 2 ? 2 : least;; ++number) {
		size_t divisor = 2;
		while (divisor * divisor <= number && number % divisor)
			++divisor;
		if (divisor * divisor > number)
			return number;
	}
}

#if _LIBCPP_AVAILABILITY_HAS_HASH_MEMORY
size_t __hash_memory(_LIBCPP_NOESCAPE const void *data, size_t size) noexcept
{
	auto *next = static_cast<const unsigned char *>(data);
	size_t hash = 2166136261u; /* FNV-1a */
	while (size--)
		hash = (hash ^ *next++) * 16777619u;
	return hash;
}
#endif

/* Owners of a shared_ptr are counted from 0; there is one thread. */
__shared_count::~__shared_count() {}

__shared_weak_count::~__shared_weak_count() {}

void __shared_weak_count::__release_weak() noexcept
{
	if (__shared_weak_owners_-- == 0)
		__on_zero_shared_weak();
}

__shared_weak_count *__shared_weak_count::lock() noexcept
{
	if (__shared_owners_ < 0)
		return nullptr;
	++__shared_owners_;
	return this;
}

const void *__shared_weak_count::__get_deleter(const type_info &) const noexcept
{
	return nullptr;
}

_LIBCPP_END_NAMESPACE_STD
