/* Exceptions of C++ on WebAssembly, as LLVM asks for them where a processor has none.
 *
 * A function that has to do something when an exception passes makes its calls by the host's
 * invoke_..., which come back with __THREW__ set where one has ended them. It then asks here which
 * of its handlers is meant, and enters that one, or lets the exception go on.
 *
 * Sources: LLVM, WebAssemblyLowerEmscriptenEHSjLj.cpp, for what the functions are called and take;
 * Itanium C++ ABI: Exception Handling, 2.4 and 2.5, for what they do. */

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <initializer_list>
#include <typeinfo>

#include "private_typeinfo.h"

extern "C" [[noreturn]] void plc_assert(const char *reason);
extern "C" [[noreturn]] void plc_exception(const char *reason, int again);
extern "C" void setTempRet0(int value);

namespace {

using Type = const __cxxabiv1::__shim_type_info *;

/* What lies before an object that was thrown.
 *
 * handlers: that have begun with it and not ended; negative while it is thrown once more by one.
 * destroy: its destructor, which on WebAssembly returns the address that it takes.
 * adjusted: its address as the handler sees it: that of a base, of what a pointer points to. */
struct alignas(16) Thrown {
	const std::type_info *type;
	void *(*destroy)(void *);
	void *adjusted;
	Thrown *before;
	int handlers;

	void *object() { return this + 1; }
};

Thrown *caught; /* by the handlers that are running, the innermost first */
Thrown *passing;

Thrown *of_object(void *object) { return static_cast<Thrown *>(object) - 1; }

bool can_catch(const std::type_info *type, Thrown *thrown, void *&adjusted)
{
	adjusted = thrown->object();
	return static_cast<Type>(type)->can_catch(static_cast<Type>(thrown->type), adjusted);
}

const char *told(Thrown *thrown)
{
	static char text[200];
	void *object;
	const char *name = thrown->type->name(), *what = "", *between = "";
	char number[12] = "";
	if (name[0] == 'S' && name[1] == 't')
		name += 2;
	while (*name >= '0' && *name <= '9')
		++name;
	if (can_catch(&typeid(std::exception), thrown, object))
		what = static_cast<std::exception *>(object)->what(), between = ": ";
	else if (can_catch(&typeid(const char *), thrown, object))
		what = static_cast<const char *>(object), name = "";
	else if (*thrown->type == typeid(int))
		snprintf(number, sizeof number, "%d", *static_cast<int *>(thrown->object())), name = "";
	snprintf(text, sizeof text, "an exception of C++ that nobody catches: %s%s%s%s", name, between, what, number);
	return text;
}

[[noreturn]] void pass(Thrown *thrown, int again)
{
	passing = thrown;
	plc_exception(told(thrown), again);
}

/* Returns the object for a handler, and its type as a second result: the first that can catch it, or its own. */
void *matching(std::initializer_list<const std::type_info *> types)
{
	const std::type_info *found = passing->type;
	for (auto *type : types) {
		if (!type)
			break;
		if (can_catch(type, passing, passing->adjusted)) {
			found = type;
			break;
		}
	}
	setTempRet0(reinterpret_cast<intptr_t>(found));
	return passing->object();
}

} // namespace

namespace std {

[[noreturn]] void terminate() noexcept { plc_assert("an exception of C++ that nobody may let pass: std::terminate"); }

} // namespace std

extern "C" {

void *__cxa_allocate_exception(size_t size)
{
	void *area = calloc(1, sizeof(Thrown) + size);
	if (!area)
		plc_assert("no memory for an exception of C++");
	return static_cast<Thrown *>(area)->object();
}

void __cxa_free_exception(void *object) { free(of_object(object)); }

[[noreturn]] void __cxa_throw(void *object, std::type_info *type, void *(*destroy)(void *))
{
	Thrown *thrown = of_object(object);
	thrown->type = type;
	thrown->destroy = destroy;
	pass(thrown, 0);
}

[[noreturn]] void __resumeException(void *object) { pass(of_object(object), 1); }

void *__cxa_get_exception_ptr(void *object) { return of_object(object)->adjusted; }

void *__cxa_begin_catch(void *object)
{
	Thrown *thrown = of_object(object);
	thrown->handlers = (thrown->handlers < 0 ? -thrown->handlers : thrown->handlers) + 1;
	if (caught != thrown) {
		thrown->before = caught;
		caught = thrown;
	}
	return thrown->adjusted;
}

void __cxa_end_catch(void)
{
	Thrown *thrown = caught;
	bool is_thrown_again = thrown->handlers < 0;
	thrown->handlers += is_thrown_again ? 1 : -1;
	if (thrown->handlers)
		return;
	caught = thrown->before;
	if (is_thrown_again)
		return;
	if (thrown->destroy)
		thrown->destroy(thrown->object());
	free(thrown);
}

[[noreturn]] void __cxa_rethrow(void)
{
	if (!caught)
		std::terminate();
	caught->handlers = -caught->handlers;
	pass(caught, 0);
}

[[noreturn]] void __cxa_call_unexpected(void *) { plc_assert("an exception of C++ that its function does not declare"); }

int llvm_eh_typeid_for(const std::type_info *type) { return reinterpret_cast<intptr_t>(type); }

using T = const std::type_info *;
void *__cxa_find_matching_catch_2(void) { return matching({}); }
void *__cxa_find_matching_catch_3(T a) { return matching({a}); }
void *__cxa_find_matching_catch_4(T a, T b) { return matching({a, b}); }
void *__cxa_find_matching_catch_5(T a, T b, T c) { return matching({a, b, c}); }
void *__cxa_find_matching_catch_6(T a, T b, T c, T d) { return matching({a, b, c, d}); }
void *__cxa_find_matching_catch_7(T a, T b, T c, T d, T e) { return matching({a, b, c, d, e}); }
void *__cxa_find_matching_catch_8(T a, T b, T c, T d, T e, T f) { return matching({a, b, c, d, e, f}); }
void *__cxa_find_matching_catch_9(T a, T b, T c, T d, T e, T f, T g) { return matching({a, b, c, d, e, f, g}); }
void *__cxa_find_matching_catch_10(T a, T b, T c, T d, T e, T f, T g, T h)
{
	return matching({a, b, c, d, e, f, g, h});
}

[[noreturn]] void __abort_message(const char *format, ...) { plc_assert(format); }

} // extern "C"
