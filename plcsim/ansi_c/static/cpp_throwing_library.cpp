/* C++'s library as cpp_library.cpp has it, for programs with exceptions: what ended them throws. It is a file
 * of its own, as LLVM's calls in it must not be to functions of the same file. */

#include "cpp_library.cpp"

#include <new>
#include <typeinfo>

extern "C" [[noreturn]] void __cxa_bad_cast(void) { throw std::bad_cast(); }
extern "C" [[noreturn]] void __cxa_bad_typeid(void) { throw std::bad_typeid(); }
extern "C" [[noreturn]] void __cxa_throw_bad_array_new_length(void) { throw std::bad_array_new_length(); }

namespace std {

bad_function_call::~bad_function_call() noexcept {}
const char *bad_function_call::what() const noexcept { return "std::bad_function_call"; }

} // namespace std
