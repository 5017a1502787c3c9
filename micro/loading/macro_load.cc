#include "micro/loading/macro_load.h"

#include <Eigen/LU>

namespace spall {
namespace {

struct Split {
  std::vector<Eigen::Index> free, held;
};
template<std::size_t size> Split split(const std::array<bool, size>& free) {
  Split parts;
  for (std::size_t i = 0; i < size; ++i) (free[i] ? parts.free : parts.held).push_back(i);
  return parts;
}

} // namespace

// Stationarity of the energy in the free strains: C_ff e_f = G_f^T w - C_fh e_h.
template<int dim>
CondensedCell<dim> release(const CondensedCell<dim>& cell, const std::array<bool, voigt_size<dim>>& free) {
  const auto [f, h] = split(free);
  if (f.empty()) return cell;
  const Eigen::MatrixXd compliance = Eigen::MatrixXd(cell.uncracked(f, f)).inverse();
  const Eigen::MatrixXd Gf = cell.coupling(Eigen::all, f), Cfh = cell.uncracked(f, h);
  CondensedCell<dim> result = cell;
  result.stiffness -= Gf * compliance * Gf.transpose();
  result.coupling.setZero();
  result.coupling(Eigen::all, h) = cell.coupling(Eigen::all, h) - Gf * compliance * Cfh;
  result.uncracked.setZero();
  result.uncracked(h, h) = cell.uncracked(h, h) - Cfh.transpose() * compliance * Cfh;
  return result;
}

template<int dim>
Voigt<dim> complete_strain(const CondensedCell<dim>& cell, const std::array<bool, voigt_size<dim>>& free,
                           const Voigt<dim>& strain, const Eigen::VectorXd& opening) {
  const auto [f, h] = split(free);
  Voigt<dim> complete = strain;
  if (f.empty()) return complete;
  const Eigen::VectorXd right = (cell.coupling.transpose() * opening)(f)-cell.uncracked(f, h) * strain(h);
  complete(f) = Eigen::VectorXd(Eigen::MatrixXd(cell.uncracked(f, f)).inverse() * right);
  return complete;
}

#define SPALL_INSTANTIATE(dim)                                                                               \
  template CondensedCell<dim> release(const CondensedCell<dim>&, const std::array<bool, voigt_size<dim>>&);  \
  template Voigt<dim> complete_strain(const CondensedCell<dim>&, const std::array<bool, voigt_size<dim>>&,   \
                                      const Voigt<dim>&, const Eigen::VectorXd&);
SPALL_INSTANTIATE(2)
SPALL_INSTANTIATE(3)
#undef SPALL_INSTANTIATE

} // namespace spall
