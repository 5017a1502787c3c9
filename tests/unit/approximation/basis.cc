// Tests of the reproduced monomials for every kernel, support shape and order of the basis.

#include "macro/approximation/monomial_basis.h"
#include "tests/unit/approximation/clouds.h"

#include <gtest/gtest.h>

#include <functional>

namespace spall::test {
namespace {

template<class Basis_, int order_, class T_> struct Choice {
  using Basis = Basis_;
  using T = T_;
  static constexpr int order = order_;
};
template<class Kernel, class T>
using OfKernel = std::tuple<Choice<MonomialBasis<Kernel, 0>, 0, T>, Choice<LinearBasis<Kernel>, 1, T>,
                            Choice<MonomialBasis<Kernel, 1>, 1, T>, Choice<MonomialBasis<Kernel, 2>, 2, T>>;
template<class... Tuples> struct Joined;
template<class... A> struct Joined<std::tuple<A...>> { using Types = ::testing::Types<A...>; };
template<class... A, class... B, class... More> struct Joined<std::tuple<A...>, std::tuple<B...>, More...> {
  using Types = typename Joined<std::tuple<A..., B...>, More...>::Types;
};
using Choices = Joined<OfKernel<Ball<CubicSpline>, double>, OfKernel<Ball<CubicSpline>, float>,
                       OfKernel<Ball<WendlandC4>, double>, OfKernel<Box<CubicSpline>, double>,
                       OfKernel<Box<WendlandC4>, double>, OfKernel<Box<WendlandC4>, float>>::Types;

template<class C> class Basis : public ::testing::Test {};
TYPED_TEST_SUITE(Basis, Choices);

/// All monomials up to an order, with their gradients.
struct Monomial {
  int power[3];
  double operator()(double x, double y, double z) const {
    return std::pow(x, power[0]) * std::pow(y, power[1]) * std::pow(z, power[2]);
  }
  double derivative(int axis, const double (&x)[3]) const {
    if (power[axis] == 0) return 0;
    Monomial lower = *this;
    --lower.power[axis];
    return power[axis] * lower(x[0], x[1], x[2]);
  }
};
std::vector<Monomial> monomials(int order) {
  std::vector<Monomial> all;
  for (int a = 0; a <= order; ++a)
    for (int b = 0; a + b <= order; ++b)
      for (int c = 0; a + b + c <= order; ++c) all.push_back({{a, b, c}});
  return all;
}

/// Spacing of clouds that are dense enough for the quadratic basis at faces, edges and corners.
constexpr double dense = 0.3;

template<class T> std::vector<Vec<T>> places() {
  return {{0, 0, 0}, {T(0.1), T(0.07), T(0.12)}, {T(-0.05), T(0.15), 0}};
}

template<class T> double sum(const std::vector<T>& weights, const Cloud<T>& cloud, const Monomial& f) {
  double total = 0;
  for (std::size_t j = 0; j < cloud.size(); ++j)
    total += static_cast<double>(weights[j]) * f(cloud.xi[0][j], cloud.xi[1][j], cloud.xi[2][j]);
  return total;
}

template<class Operator, class T>
std::array<std::vector<T>, 12> gradients(const Operator& op, const Cloud<T>& cloud,
                                         const Mat<T>& inverse = {1, 0, 0, 0, 1, 0, 0, 0, 1}) {
  std::array<std::vector<T>, 12> d;
  std::array<T*, 12> out{};
  for (int k = 0; k < 3; ++k) d[k].resize(cloud.size()), out[k] = d[k].data();
  op.template differentiate<false>(cloud, inverse, T(1), out);
  return d;
}

TYPED_TEST(Basis, ReproducesItsMonomialsAndTheirGradients) {
  using T = typename TypeParam::T;
  const double tolerance = 20 * round_off<T>;
  for (auto& [name, cloud] : sound_clouds<T>(dense)) {
    if (name == "random" && TypeParam::order == 2)
      continue; // 40 random points may not resolve the quadratic basis
    for (const auto& at : places<T>()) {
      const auto op = TypeParam::Basis::template evaluate<false>(cloud, at);
      ASSERT_FALSE(op.lowered()) << name;
      std::vector<T> psi(cloud.size());
      op.values(cloud, psi.data());
      const auto g = gradients(op, cloud);
      const double x[3] = {static_cast<double>(at[0]), static_cast<double>(at[1]),
                           static_cast<double>(at[2])};
      for (const Monomial& f : monomials(TypeParam::order)) {
        EXPECT_NEAR(sum(psi, cloud, f), f(x[0], x[1], x[2]), tolerance) << name;
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(sum(g[i], cloud, f), f.derivative(i, x), 10 * tolerance) << name;
      }
    }
  }
}

TYPED_TEST(Basis, ConstantsAreExactOverAnyCloud) {
  using T = typename TypeParam::T;
  for (auto& [name, cloud] : singular_clouds<T>()) {
    const auto op = TypeParam::Basis::template evaluate<false>(cloud, Vec<T>{});
    EXPECT_EQ(op.lowered(), TypeParam::order > 0) << name;
    std::vector<T> psi(cloud.size());
    op.values(cloud, psi.data());
    EXPECT_NEAR(sum(psi, cloud, {{0, 0, 0}}), 1, round_off<T>) << name;
    const auto g = gradients(op, cloud);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum(g[i], cloud, {{0, 0, 0}}), 0, 10 * round_off<T>) << name;
  }
}

template<class Kernel> void expect_gradient_of_the_shape_function() {
  using Shepard = MonomialBasis<Kernel, 0>;
  const double h = 1e-6;
  for (auto& [name, cloud] : sound_clouds<double>()) {
    const auto g = gradients(Shepard::template evaluate<false>(cloud, Vec3{}), cloud);
    for (int k = 0; k < 3; ++k) {
      std::vector<double> ahead(cloud.size()), behind(cloud.size());
      Vec3 at{};
      at[k] = h;
      Shepard::template evaluate<false>(cloud, at).values(cloud, ahead.data());
      at[k] = -h;
      Shepard::template evaluate<false>(cloud, at).values(cloud, behind.data());
      for (std::size_t j = 0; j < cloud.size(); ++j)
        EXPECT_NEAR(g[k][j], (ahead[j] - behind[j]) / (2 * h), 1e-4) << name;
    }
  }
}

TEST(BasisOfOrderZero, HasTheGradientOfTheShapeFunction) {
  expect_gradient_of_the_shape_function<Ball<CubicSpline>>();
  expect_gradient_of_the_shape_function<Ball<WendlandC4>>();
  expect_gradient_of_the_shape_function<Box<CubicSpline>>();
  expect_gradient_of_the_shape_function<Box<WendlandC4>>();
}

template<class BasisOf, class T>
std::array<std::vector<T>, 12> all_derivatives(Cloud<T>& cloud, const Vec<T>& at = {}, T weight = 1) {
  const Mat<T> inverse = {T(1.3), T(0.2), 0, T(-0.1), T(0.9), T(0.3), 0, 0, T(1.1)};
  const auto op = BasisOf::template evaluate<true>(cloud, at);
  std::array<std::vector<T>, 12> d;
  std::array<T*, 12> out{};
  for (int k = 0; k < 12; ++k) d[k].resize(cloud.size()), out[k] = d[k].data();
  op.template differentiate<true>(cloud, inverse, weight, out);
  return d;
}

template<class Kernel> void expect_same_linear_basis() {
  auto clouds = sound_clouds<double>();
  for (auto& singular : singular_clouds<double>()) clouds.push_back(singular);
  for (auto& [name, cloud] : clouds) {
    const auto fast = all_derivatives<LinearBasis<Kernel>>(cloud, {}, 0.3),
               textbook = all_derivatives<MonomialBasis<Kernel, 1>>(cloud, {}, 0.3);
    for (int k = 0; k < 12; ++k)
      for (std::size_t j = 0; j < cloud.size(); ++j)
        EXPECT_NEAR(fast[k][j], textbook[k][j], 1e-10 * (1 + std::abs(fast[k][j]))) << name << k;
  }
}

TEST(LinearBasisTest, IsTheTextbooksInEveryDerivativeAndAlsoWhereRegularised) {
  expect_same_linear_basis<Ball<CubicSpline>>();
  expect_same_linear_basis<Ball<WendlandC4>>();
  expect_same_linear_basis<Box<CubicSpline>>();
}

template<class BasisOf> void expect_derivative_of_gradient() {
  const double h = 1e-5;
  for (auto& [name, cloud] : sound_clouds<double>(dense)) {
    if (name == "random") continue;
    const auto exact = all_derivatives<BasisOf>(cloud);
    for (int k = 0; k < 3; ++k) {
      Vec3 at{};
      at[k] = h;
      const auto ahead = all_derivatives<BasisOf>(cloud, at);
      at[k] = -h;
      const auto behind = all_derivatives<BasisOf>(cloud, at);
      for (int i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < cloud.size(); ++j)
          EXPECT_NEAR(exact[3 + 3 * k + i][j], (ahead[i][j] - behind[i][j]) / (2 * h),
                      2e-4 * (1 + std::abs(exact[3 + 3 * k + i][j])))
              << name;
    }
  }
}

TEST(GradientDerivativeOfAnyKernel, IsTheChangeOfTheGradientWhenThePlaceMoves) {
  expect_derivative_of_gradient<LinearBasis<Ball<WendlandC4>>>();
  expect_derivative_of_gradient<LinearBasis<Box<WendlandC4>>>();
  expect_derivative_of_gradient<MonomialBasis<Ball<WendlandC4>, 2>>();
  expect_derivative_of_gradient<MonomialBasis<Box<WendlandC4>, 2>>();
}

TEST(QuadraticBasis, IsTheLinearOneWhereItsTermsAreNotResolved) {
  // A lattice with a support of two spacings has two layers at a face: x^2 and x are the same there.
  using Kernel = Ball<CubicSpline>;
  constexpr Mat3 none = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (const Part part : {Part::face, Part::edge, Part::corner}) {
    auto cloud = lattice_cloud<double>(part, 0.5, 0, none, 1);
    const auto op = MonomialBasis<Kernel, 2>::evaluate<true>(cloud, Vec3{});
    EXPECT_TRUE(op.lowered());
    EXPECT_FALSE(op.outside());
    const auto quadratic = all_derivatives<MonomialBasis<Kernel, 2>>(cloud),
               linear = all_derivatives<LinearBasis<Kernel>>(cloud);
    for (int k = 0; k < 12; ++k)
      for (std::size_t j = 0; j < cloud.size(); ++j) EXPECT_NEAR(quadratic[k][j], linear[k][j], 1e-10);
  }
}

template<class Kernel> double quadratic_fraction(Part part, double spacing) {
  constexpr Mat3 none = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  auto cloud = lattice_cloud<double>(part, spacing, 0, none, 1, Kernel::is_box);
  return MonomialBasis<Kernel, 2>::template evaluate<false>(cloud, Vec3{}).fraction();
}

TEST(QuadraticBasis, TheFractionOfADenseCloudIsOne) {
  EXPECT_NEAR(quadratic_fraction<Ball<CubicSpline>>(Part::bulk, 0.08), 1, 0.02);
  EXPECT_NEAR(quadratic_fraction<Ball<WendlandC4>>(Part::bulk, 0.08), 1, 0.02);
  EXPECT_NEAR(quadratic_fraction<Box<CubicSpline>>(Part::bulk, 0.1), 1, 0.02);
  EXPECT_NEAR(quadratic_fraction<Box<WendlandC4>>(Part::bulk, 0.1), 1, 0.02);
}

TEST(QuadraticBasis, OutermostPointsOfALatticeHaveTheDocumentedFractions) {
  using Kernel = Ball<CubicSpline>;
  EXPECT_NEAR(quadratic_fraction<Kernel>(Part::bulk, 1. / 3), 1.1, 0.05);
  EXPECT_NEAR(quadratic_fraction<Kernel>(Part::face, 1. / 3), 0.030, 0.001);
  EXPECT_NEAR(quadratic_fraction<Kernel>(Part::edge, 1. / 3), 8e-4, 0.2e-4);
  EXPECT_NEAR(quadratic_fraction<Kernel>(Part::corner, 1. / 3), 2e-5, 0.1e-5);
  EXPECT_NEAR(quadratic_fraction<Kernel>(Part::face, 1. / 2.5), 0.011, 0.001);
  EXPECT_NEAR(quadratic_fraction<Kernel>(Part::corner, 1. / 2.5), 4e-6, 0.5e-6);
}

} // namespace
} // namespace spall::test
