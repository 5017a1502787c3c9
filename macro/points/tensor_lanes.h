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

/// Converts tensors to another precision.
template<int L, class To, class From, template<class> class A>
A<Lanes<To, L>> convert_lanes(const A<Lanes<From, L>>& a) {
  A<Lanes<To, L>> converted;
  for_each_component<A<From>>([&](std::size_t k) { converted[k] = convert_lanes<L, To, From>(a[k]); });
  return converted;
}

} // namespace spall
