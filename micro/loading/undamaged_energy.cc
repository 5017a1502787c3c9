#include "micro/loading/undamaged_energy.h"

namespace spall {

template<int dim>
SplitEnergy undamaged_energy(const CondensedCell<dim>& cell, const MacroLoad<dim>& load,
                             double youngs_modulus, double poisson_ratio) {
  const Voigt<dim> strain =
      complete_strain(cell, load.free, load.direction, Eigen::VectorXd::Zero(cell.stiffness.rows()));
  const SplitEnergy unit = spectral_split<dim>(strain, poisson_ratio);
  return {youngs_modulus * unit.plus, youngs_modulus * unit.minus};
}

template SplitEnergy undamaged_energy(const CondensedCell<2>&, const MacroLoad<2>&, double, double);
template SplitEnergy undamaged_energy(const CondensedCell<3>&, const MacroLoad<3>&, double, double);

} // namespace spall
