/* Read before a source in C++ that throws, catches or asks for types at run time: who reads it is
 * linked with cpp_exceptions.cpp. */
