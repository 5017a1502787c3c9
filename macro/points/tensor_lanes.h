#pragma once

#include "macro/points/lanes.h"
#include "macro/points/tensor.h"

namespace spall {

/// Tensors side by side, one per lane: the same operations act on all of them at once.
template<int L> using SymLanes = Sym<Lanes<double, L>>;
template<int L> using MatLanes = Mat<Lanes<double, L>>;

/// The tensor in lane m.
template<int L, template<class> class A> A<double> lane(const A<Lanes<double, L>>& a, int m) {
  A<double> one;
  for_each_component<A<double>>([&](std::size_t k) { one[k] = get_lane<L, double>(a[k], m); });
  return one;
}

/// Puts a tensor into lane m.
template<int L, template<class> class A> void put_lane(A<Lanes<double, L>>& a, int m, const A<double>& one) {
  for_each_component<A<double>>([&](std::size_t k) { set_lane<L, double>(a[k], m, one[k]); });
}

/// Tensors of L points, one per lane, and back. @param at where the tensor of each point is
template<int L, template<class> class A, class T>
A<Lanes<T, L>> side_by_side(const std::array<const A<T>*, L>& at) {
  std::array<const T*, L> numbers;
  for (int m = 0; m < L; ++m) numbers[m] = at[m]->components.data();
  return {side_by_side<static_cast<int>(A<T>::size()), L, T, T>(numbers)};
}
template<int L, template<class> class A, class T>
void one_by_one(const A<Lanes<T, L>>& lanes, const std::array<A<T>*, L>& at) {
  std::array<T*, L> numbers;
  for (int m = 0; m < L; ++m) numbers[m] = at[m]->components.data();
  one_by_one<static_cast<int>(A<T>::size()), L, T, T>(lanes.components, numbers);
}

/// Tensors of P points, one per gradient operator in the lanes of each, turned around: a tensor per operator,
/// with the points in its lanes, in double. And back. @param at where the tensors of each point are
template<int L, int P, class T, template<class> class A>
std::array<A<Lanes<double, P>>, L> by_operator(const std::array<const A<Lanes<T, L>>*, P>& at) {
  constexpr int size = A<T>::size();
  std::array<const T*, P> numbers;
  for (int p = 0; p < P; ++p) numbers[p] = reinterpret_cast<const T*>(at[p]);
  const auto all = side_by_side<size * L, P, double, T>(numbers);
  std::array<A<Lanes<double, P>>, L> turned;
  for (int c = 0; c < size; ++c)
    for (int m = 0; m < L; ++m) turned[m][c] = all[L * c + m];
  return turned;
}
template<int L, int P, class T, template<class> class A>
void by_point(const std::array<A<Lanes<double, P>>, L>& of_operators,
              const std::array<A<Lanes<T, L>>*, P>& at) {
  constexpr int size = A<T>::size();
  std::array<Lanes<double, P>, std::size_t{size * L}> all;
  for (int c = 0; c < size; ++c)
    for (int m = 0; m < L; ++m) all[L * c + m] = of_operators[m][c];
  std::array<T*, P> numbers;
  for (int p = 0; p < P; ++p) numbers[p] = reinterpret_cast<T*>(at[p]);
  one_by_one<size * L, P, T, double>(all, numbers);
}

/// Where the values of an array are.
template<class Value, std::size_t P>
std::array<const Value*, P> places_of(const std::array<Value, P>& values) {
  std::array<const Value*, P> at;
  for (std::size_t p = 0; p < P; ++p) at[p] = &values[p];
  return at;
}
template<class Value, std::size_t P> std::array<Value*, P> places_of(std::array<Value, P>& values) {
  std::array<Value*, P> at;
  for (std::size_t p = 0; p < P; ++p) at[p] = &values[p];
  return at;
}

/// Converts tensors to another precision.
template<int L, class To, class From, template<class> class A>
A<Lanes<To, L>> convert_lanes(const A<Lanes<From, L>>& a) {
  A<Lanes<To, L>> converted;
  for_each_component<A<From>>([&](std::size_t k) { converted[k] = convert_lanes<L, To, From>(a[k]); });
  return converted;
}

} // namespace spall
