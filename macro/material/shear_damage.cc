#include "macro/material/shear_damage.h"

namespace spall {

void ShearDamage::declare(Parameters::Section& section) {
  const Range not_negative{0};
  section.flag("Shear damage", active, "Eq. 24");
  section.quantity("D1", D1, Dimension::inverse_stress, not_negative, "shear damage, Eq. 24");
  section.number("Failure strain floor", floor, not_negative,
                 "smallest plastic strain to failure in Eq. 24, where D1 P vanishes; 0: as printed");
  section.quantity("Shear damage reference length", reference, Dimension::length, not_negative,
                   "spacing that the strain to failure of Eq. 24 belongs to; at another one it is scaled "
                   "inversely, so that a shear band dissipates the same per area; 0: never scaled");
}

} // namespace spall
