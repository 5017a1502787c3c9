#include "micro/output/energy_report.h"

#include <cstdio>

namespace spall {

void report_energies(const EnergyChecks& checks, bool friction, Summary& summary) {
  const bool stress = friction || checks.stress <= EnergyChecks::stress_tolerance,
             work = checks.work <= EnergyChecks::work_tolerance;
  summary.set("energy_balance_error", checks.work);
  summary.set("energy_balance_tolerance", EnergyChecks::work_tolerance);
  summary.set("psi_against_stress_error", checks.stress);
  summary.set("psi_against_stress_tolerance", EnergyChecks::stress_tolerance);
  summary.set("energy_checks_passed", stress && work);
  std::printf("  free energy, integrated over bulk and cracks, in units of its largest value:\n"
              "    against stress x strain / 2     within %.1e, allowed %.0e%s\n"
              "    against work minus dissipation  within %.1e, allowed %.0e%s\n",
              checks.stress, EnergyChecks::stress_tolerance,
              friction ? " (not applicable with friction)"
              : stress ? ""
                       : " EXCEEDED",
              checks.work, EnergyChecks::work_tolerance, work ? "" : " EXCEEDED");
  if (!stress)
    std::printf("  caution: states are not in equilibrium and the damage is not reliable; use a smaller "
                "Solver/Tolerance\n");
  if (!work)
    std::printf("  caution: rows are too far apart to integrate the work accurately; use a smaller "
                "Loading/Row growth and Loading/Stress change\n");
}

} // namespace spall
