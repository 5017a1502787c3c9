#include "macro/material/hydrostat.h"

namespace spall {

void Hydrostat::declare(Parameters::Section& section) {
  const Range positive{above_zero};
  section.quantity("C6", C6, Dimension::stress, positive, "pressure where crushing begins");
  section.number("C7", C7, positive, "volumetric strain where crushing begins");
  section.quantity("C8", C8, Dimension::stress, positive, "locking modulus");
  section.number("C9", C9, positive, "volumetric strain at locking");
  section.quantity("K1", K1, Dimension::stress, {}, "crushing curve, Eq. 21");
  section.quantity("K2", K2, Dimension::stress, {}, "crushing curve, Eq. 21");
  section.quantity("K3", K3, Dimension::stress, {}, "crushing curve, Eq. 21");
  section.choice("Hydrostat", form,
                 {{"shifted", HydrostatForm::shifted}, {"printed", HydrostatForm::printed}},
                 "Eq. 21 in mu - C7 from the point (C7, C6), or as printed (not continuous)");
  section.choice(
      "Unloading", unloading, {{"interpolated", Unloading::interpolated}, {"elastic", Unloading::elastic}},
      "bulk modulus below the largest compression: from C6 / C7 at C7 to C8 at C9, or C6 / C7 up to "
      "C9 and C8 beyond");
}

} // namespace spall
