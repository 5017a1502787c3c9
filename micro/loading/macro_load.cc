#include "micro/loading/macro_load.h"

#include <Eigen/LU>

namespace spall {
namespace {

struct Split {
  std::vector<Eigen::Index> free, held;
};
Split split(const std::array<bool, 3>& free) {
  Split parts;
  for (Eigen::Index i = 0; i < 3; ++i) (free[i] ? parts.free : parts.held).push_back(i);
  return parts;
}

} // namespace

// Stationarity of the energy in the free strains: C_ff e_f = G_f^T w - C_fh e_h.
CondensedCell release(const CondensedCell& cell, const std::array<bool, 3>& free) {
  const auto [f, h] = split(free);
  if (f.empty()) return cell;
  const Eigen::MatrixXd compliance = Eigen::MatrixXd(cell.uncracked(f, f)).inverse();
  const Eigen::MatrixXd Gf = cell.coupling(Eigen::all, f), Cfh = cell.uncracked(f, h);
  CondensedCell result = cell;
  result.stiffness -= Gf * compliance * Gf.transpose();
  result.coupling.setZero();
  result.coupling(Eigen::all, h) = cell.coupling(Eigen::all, h) - Gf * compliance * Cfh;
  result.uncracked.setZero();
  result.uncracked(h, h) = cell.uncracked(h, h) - Cfh.transpose() * compliance * Cfh;
  return result;
}

Voigt complete_strain(const CondensedCell& cell, const std::array<bool, 3>& free, const Voigt& strain,
                      const Eigen::VectorXd& opening) {
  const auto [f, h] = split(free);
  Voigt complete = strain;
  if (f.empty()) return complete;
  const Eigen::VectorXd right = (cell.coupling.transpose() * opening)(f)-cell.uncracked(f, h) * strain(h);
  complete(f) = Eigen::VectorXd(Eigen::MatrixXd(cell.uncracked(f, f)).inverse() * right);
  return complete;
}

} // namespace spall
