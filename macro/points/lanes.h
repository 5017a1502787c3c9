#pragma once

namespace spall {

/// Four numbers that are computed alike: the processor's vector unit where there is one, plain code elsewhere
/// (a vector extension of g++ and clang, correct on every machine).
template<class T> struct LanesOf { typedef T type __attribute__((vector_size(4 * sizeof(T)))); };
template<class T> using Lanes = typename LanesOf<T>::type;

} // namespace spall
