// Numbers of several records, side by side in vectors and back.

#include "macro/points/tensor_lanes.h"

#include <gtest/gtest.h>

#include <vector>

namespace spall::test {
namespace {

/// Records of N numbers, all different and exact in single precision.
template<int N, int L, class T> std::array<std::array<T, N>, L> records() {
  std::array<std::array<T, N>, L> made;
  for (std::size_t m = 0; m < L; ++m)
    for (std::size_t k = 0; k < N; ++k) made[m][k] = static_cast<T>(100 * m + k);
  return made;
}

template<int N, int L, class From, class To> void expect_there_and_back() {
  const auto made = records<N, L, From>();
  std::array<const From*, L> from;
  for (std::size_t m = 0; m < L; ++m) from[m] = made[m].data();
  const auto lanes = side_by_side<N, L, To, From>(from);
  for (std::size_t k = 0; k < N; ++k)
    for (std::size_t m = 0; m < L; ++m)
      EXPECT_EQ((get_lane<L, To>(lanes[k], static_cast<int>(m))), static_cast<To>(made[m][k]));
  std::array<std::array<From, N>, L> back{};
  std::array<From*, L> to;
  for (std::size_t m = 0; m < L; ++m) to[m] = back[m].data();
  one_by_one<N, L, From, To>(lanes, to);
  EXPECT_EQ(back, made);
}

TEST(Lanes, RecordsSideBySideComeBackOneByOne) {
  expect_there_and_back<1, 8, double, double>();
  expect_there_and_back<3, 8, double, double>();
  expect_there_and_back<6, 8, double, double>();
  expect_there_and_back<9, 8, double, double>();
  expect_there_and_back<9, 8, float, double>();
  expect_there_and_back<36, 8, float, double>();
  expect_there_and_back<72, 8, double, double>();
  expect_there_and_back<6, 4, float, double>();
  expect_there_and_back<6, 1, double, double>();
}

TEST(Lanes, OfOperatorsArePutInOrderOfPoints) {
  constexpr int L = 4, P = 8;
  std::array<Sym<Lanes<float, L>>, P> of_points, back;
  for (std::size_t p = 0; p < P; ++p)
    for (std::size_t c = 0; c < 6; ++c)
      for (std::size_t m = 0; m < L; ++m) of_points[p][c][m] = static_cast<float>(100 * p + 10 * c + m);
  const auto of_operators = by_operator<L, P, float>(places_of(std::as_const(of_points)));
  for (std::size_t m = 0; m < L; ++m)
    for (std::size_t c = 0; c < 6; ++c)
      for (std::size_t p = 0; p < P; ++p)
        EXPECT_EQ(of_operators[m][c][p], static_cast<double>(of_points[p][c][m]));
  by_point<L, P, float>(of_operators, places_of(back));
  for (std::size_t p = 0; p < P; ++p)
    for (int m = 0; m < L; ++m) {
      const Sym<float> after = {back[p][0][m], back[p][1][m], back[p][2][m],
                                back[p][3][m], back[p][4][m], back[p][5][m]};
      for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(after[c], of_points[p][c][m]);
    }
}

TEST(Lanes, JoinAndPartAreInverse) {
  const Lanes<double> a = {1, 2, 3, 4}, b = {5, 6, 7, 8};
  const Lanes<double, 8> both = join(a, b);
  for (int m = 0; m < 8; ++m) EXPECT_EQ(both[m], m + 1);
  const Lanes<double> second = part<4, 4>(both);
  for (int m = 0; m < 4; ++m) EXPECT_EQ(second[m], b[m]);
}

/// Numbers times vectors of four, in registers of any width: the loop of the forces.
template<class T> void expect_sum_of_products() {
  const std::array<T, 16> numbers = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  constexpr std::size_t quarter = register_lanes<T> / 4;
  std::array<Lanes<T>, 4> fours;
  for (std::size_t n = 0; n < 4; ++n) fours[n] = Lanes<T>{T(n + 1), T(10 * n), T(n * n), T(1)};
  const auto registers = registers_of<T>(fours);
  const Register<T> read = read_register(numbers.data());
  Register<T> sum{};
  std::size_t used = 0; // numbers 1, 2, ... as far as the register and the vectors reach
  unrolled<4>([&](auto q) {
    if (q < registers.size()) sum += four_times<q>(read) * registers[q], used += quarter;
  });
  const Lanes<T> folded = sum_of_fours<T>(sum);
  for (int c = 0; c < 4; ++c) {
    T expected = 0;
    for (std::size_t n = 0; n < used; ++n) expected += numbers[n] * fours[n][c];
    EXPECT_EQ(folded[c], expected);
  }
  EXPECT_EQ(used, 4u);
}

TEST(Lanes, NumbersTimesVectorsOfFour) {
  expect_sum_of_products<float>();
  expect_sum_of_products<double>();
}

} // namespace
} // namespace spall::test
