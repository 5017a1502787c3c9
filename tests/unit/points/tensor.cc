// Tests of the tensor algebra, with Eigen as the independent reference.

#include "macro/points/tensor_lanes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <random>

namespace spall::test {
namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

class RandomTensors {
public:
  double number() { return range(engine); }
  Mat3 matrix() {
    Mat3 a;
    for (double& x : a) x = number();
    return a;
  }
  Sym3 symmetric() {
    Sym3 a;
    for (double& x : a) x = number();
    return a;
  }
  Vec3 vector() { return {number(), number(), number()}; }
  /// Returns a proper orthogonal matrix, from the QR decomposition of a random matrix.
  Mat3 rotation() {
    const Mat3 a = matrix();
    RowMajor q = Eigen::Map<const RowMajor>(a.components.data()).householderQr().householderQ();
    if (q.determinant() < 0) q.col(0) *= -1;
    Mat3 rotation;
    Eigen::Map<RowMajor>(rotation.components.data()) = q;
    return rotation;
  }

private:
  std::mt19937 engine{3};
  std::uniform_real_distribution<double> range{-1, 1};
};

RowMajor eigen(const Mat3& a) { return Eigen::Map<const RowMajor>(a.components.data()); }
RowMajor eigen(const Sym3& a) { return eigen(full(a)); }
Eigen::Vector3d eigen(const Vec3& a) { return Eigen::Map<const Eigen::Vector3d>(a.components.data()); }

void expect_near(const Mat3& a, const RowMajor& b, double tolerance) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(a(i, j), b(i, j), tolerance) << i << j;
}

constexpr int repetitions = 100;

TEST(Tensor, InverseTimesTensorIsIdentityAndDeterminantsMultiply) {
  RandomTensors random;
  for (int n = 0; n < repetitions; ++n) {
    const Mat3 a = random.matrix(), b = random.matrix();
    EXPECT_NEAR(determinant(multiply(a, b)), determinant(a) * determinant(b), 1e-13);
    if (std::abs(determinant(a)) < 0.05) continue;
    const Mat3 one = multiply(inverse(a), a);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(one[i], identity3[i], 1e-12);
  }
}

TEST(Tensor, ProductsInverseAndDeterminantAreThoseOfEigen) {
  RandomTensors random;
  int inverted = 0;
  for (int n = 0; n < repetitions; ++n) {
    const Mat3 a = random.matrix(), b = random.matrix();
    const Sym3 s = random.symmetric();
    const Vec3 v = random.vector(), w = random.vector();
    expect_near(multiply(a, b), eigen(a) * eigen(b), 1e-14);
    expect_near(transpose(a), eigen(a).transpose(), 0);
    expect_near(outer(v, w), eigen(v) * eigen(w).transpose(), 1e-15);
    expect_near(full(symmetric_part(a)), 0.5 * (eigen(a) + eigen(a).transpose()), 1e-15);
    expect_near(full(times_transpose(a)), eigen(a) * eigen(a).transpose(), 1e-14);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(times(a, v)[i], (eigen(a) * eigen(v))[i], 1e-14);
      EXPECT_NEAR(times_transposed(a, v)[i], (eigen(a).transpose() * eigen(v))[i], 1e-14);
      EXPECT_NEAR(times(s, v)[i], (eigen(s) * eigen(v))[i], 1e-14);
      EXPECT_NEAR(cross(v, w)[i], eigen(v).cross(eigen(w))[i], 1e-15);
    }
    EXPECT_NEAR(dot(v, w), eigen(v).dot(eigen(w)), 1e-14);
    EXPECT_NEAR(determinant(a), eigen(a).determinant(), 1e-14);
    EXPECT_NEAR(determinant(s), eigen(s).determinant(), 1e-14);
    EXPECT_NEAR(trace(a), eigen(a).trace(), 1e-14);
    if (std::abs(determinant(a)) > 0.05) expect_near(inverse(a), eigen(a).inverse(), 1e-12), ++inverted;
    if (std::abs(determinant(s)) > 0.05)
      expect_near(full(inverse(s, determinant(s))), eigen(s).inverse(), 1e-12);
  }
  EXPECT_GT(inverted, repetitions / 2);
}

TEST(Tensor, ContractionIsTheSumOverAllNineProducts) {
  RandomTensors random;
  for (int n = 0; n < repetitions; ++n) {
    const Sym3 a = random.symmetric(), b = random.symmetric();
    const double expected = eigen(a).cwiseProduct(eigen(b)).sum();
    EXPECT_NEAR(contract(a, b), expected, 1e-14);
    EXPECT_NEAR(contract_in_order(a, b), expected, 1e-14);
  }
  const Sym3 a = {1, 2, 3, 4, 5, 6}, b = {7, 8, 9, 10, 11, 12};
  EXPECT_EQ(contract(a, b), 7 + 16 + 27 + 2 * (40 + 55 + 72));
  EXPECT_EQ(contract_in_order(a, b), contract(a, b));
  EXPECT_NEAR(trace(deviator(a)), 0, 1e-15);
}

TEST(Tensor, ADeviatorIsTheTensorWithoutItsSphericalPart) {
  RandomTensors random;
  for (int n = 0; n < repetitions; ++n) {
    const Sym3 a = random.symmetric(), again = plus_spherical(deviator(a), trace(a) / 3);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(again[i], a[i], 1e-15);
    EXPECT_NEAR(contract(deviator(a), Sym3{1, 1, 1, 0, 0, 0}), 0, 1e-15);
  }
}

TEST(Tensor, UniaxialAndShearEquivalentStress) {
  EXPECT_NEAR(equivalent_stress(deviator(Sym3{-5, 0, 0, 0, 0, 0})), 5, 1e-14);
  EXPECT_NEAR(equivalent_stress(deviator(Sym3{0, 0, 0, 0, 2, 0})), 2 * std::sqrt(3), 1e-14);
  EXPECT_NEAR(equivalent_stress(deviator(Sym3{4, 4, 4, 0, 0, 0})), 0, 1e-14);
}

TEST(Tensor, PrincipalValuesAreTheEigenvalues) {
  RandomTensors random;
  for (int n = 0; n < repetitions; ++n) {
    const Sym3 s = random.symmetric();
    const Eigen::Vector3d ascending = Eigen::SelfAdjointEigenSolver<RowMajor>(eigen(s)).eigenvalues();
    const Vec3 values = principal_values(s);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(values[i], ascending[2 - i], 1e-7);
    EXPECT_NEAR(values[0] + values[1] + values[2], trace(s), 1e-14);
    EXPECT_EQ(largest_eigenvalue(s), values[0]);
    EXPECT_EQ(is_compressive(s), ascending[2] <= 0);
    EXPECT_EQ(is_compressive(plus_spherical(s, -2 * std::abs(ascending[2]) - 0.1)), true);
  }
}

TEST(Tensor, LargestEigenvalueIsTheLargestRayleighQuotient) {
  EXPECT_NEAR(largest_eigenvalue({3, 1, 2, 0, 0, 0}), 3, 1e-14);
  EXPECT_NEAR(largest_eigenvalue({2, 2, 2, 0, 0, 0}), 2, 1e-14);
  EXPECT_NEAR(largest_eigenvalue({0, 0, 0, 0, 1, 0}), 1, 1e-14);
  RandomTensors random;
  for (int n = 0; n < 50; ++n) {
    const Sym3 s = times_transpose(random.matrix());
    const double largest = largest_eigenvalue(s);
    // No Rayleigh quotient exceeds the eigenvalue, and s - largest is singular.
    EXPECT_NEAR(determinant(plus_spherical(s, -largest)), 0, 1e-12);
    const Vec3 v = random.vector();
    EXPECT_LE(dot(v, times(s, v)) / dot(v, v), largest + 1e-12);
  }
}

TEST(Tensor, ARotationIsQSQTransposedAndKeepsTheInvariants) {
  RandomTensors random;
  for (int n = 0; n < repetitions; ++n) {
    const Mat3 q = random.rotation();
    ASSERT_NEAR(determinant(q), 1, 1e-14);
    const Sym3 s = random.symmetric(), r = rotate(q, s);
    expect_near(full(r), eigen(q) * eigen(s) * eigen(q).transpose(), 1e-14);
    EXPECT_NEAR(trace(r), trace(s), 1e-14);
    EXPECT_NEAR(contract(r, r), contract(s, s), 1e-13);
    EXPECT_NEAR(determinant(r), determinant(s), 1e-14);
    EXPECT_NEAR(largest_eigenvalue(r), largest_eigenvalue(s), 1e-7);
    const Vec3 v = random.vector(), w = random.vector(), qv = times(q, v), qw = times(q, w);
    EXPECT_NEAR(norm(qv), norm(v), 1e-14);
    const Vec3 difference = times(q, cross(v, w)) - cross(qv, qw);
    EXPECT_NEAR(largest_component(difference), 0, 1e-14);
    EXPECT_NEAR(dot(qv, times(r, qw)), dot(v, times(s, w)), 1e-13);
  }
}

TEST(Tensor, TheAxialVectorTurnsVectorsAsTheSkewPart) {
  RandomTensors random;
  for (int n = 0; n < repetitions; ++n) {
    const Mat3 a = random.matrix();
    const Vec3 v = random.vector();
    EXPECT_NEAR(largest_component(times(0.5 * (a - transpose(a)), v) - cross(axial_vector(a), v)), 0, 1e-14);
  }
}

TEST(Tensor, LanesAreTensorsSideBySide) {
  RandomTensors random;
  MatLanes<4> a, b;
  SymLanes<4> s;
  for (int m = 0; m < 4; ++m) {
    put_lane<4>(a, m, random.matrix());
    put_lane<4>(b, m, random.matrix());
    put_lane<4>(s, m, random.symmetric());
  }
  const Mat3 q = random.rotation();
  const auto product = multiply(a, b), mixed = multiply(a, q);
  const auto turned = rotate(q, s);
  const auto sum = 2.0 * a - b / 4.0;
  for (int m = 0; m < 4; ++m) {
    const Mat3 am = lane<4>(a, m), bm = lane<4>(b, m);
    const Sym3 sm = lane<4>(s, m);
    EXPECT_LT(largest_component(lane<4>(product, m) - multiply(am, bm)), 1e-14);
    EXPECT_LT(largest_component(lane<4>(mixed, m) - multiply(am, q)), 1e-14);
    EXPECT_LT(largest_component(lane<4>(turned, m) - rotate(q, sm)), 1e-14);
    EXPECT_LT(largest_component(lane<4>(sum, m) - (2.0 * am - bm / 4.0)), 1e-14);
    EXPECT_NEAR(determinant(a)[m], determinant(am), 1e-14);
    EXPECT_NEAR(contract(s, s)[m], contract(sm, sm), 1e-14);
    EXPECT_NEAR(trace(s)[m], trace(sm), 1e-15);
  }
  const auto single = convert_lanes<4, float, double>(s);
  for (int c = 0; c < 6; ++c) EXPECT_EQ(single[c][2], static_cast<float>(s[c][2]));
}

TEST(Tensor, AVectorHasStructuredBindings) {
  const auto [x, y, z] = Vec3{1, 2, 3};
  EXPECT_EQ(x, 1);
  EXPECT_EQ(y, 2);
  EXPECT_EQ(z, 3);
  EXPECT_EQ(unit(Vec3{0, 3, 4}), (Vec3{0, 1. / 5 * 3, 1. / 5 * 4}));
  EXPECT_EQ(largest_component(Vec3{1, -7, 3}), 7);
}

} // namespace
} // namespace spall::test
