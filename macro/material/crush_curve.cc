#include "macro/material/crush_curve.h"

#include "shared/error.h"

namespace spall {

void CrushCurve::declare(Parameters::Section& section) {
  const Range positive{above_zero};
  section.quantity("Pcrush", P_crush, Dimension::stress, positive, "pressure where crushing begins");
  section.number("mu crush", mu_crush, positive, "density over initial density - 1 where crushing begins");
  section.quantity("Plock", P_lock, Dimension::stress, positive, "pressure where no pores are left");
  section.number("mu lock", mu_lock, positive,
                 "density over initial density - 1 without pores and without pressure");
  section.quantity("K1", K1, Dimension::stress, positive,
                   "pressure without pores, K1 m + K2 m^2 + K3 m^3, m = (mu - mu lock) / (1 + mu lock)");
  section.quantity("K2", K2, Dimension::stress, {}, "see K1");
  section.quantity("K3", K3, Dimension::stress, {0}, "see K1");
}

void CrushCurve::validate(const std::string& file, const std::string& section) const {
  const auto refuse = [&](const std::string& key, double found, Dimension dimension,
                          const std::string& allowed) {
    throw InputError(file + ": key '" + section + "/" + key + "': found '" +
                     format_quantity(found, dimension) + "', allowed: " + allowed);
  };
  if (!dense().grows())
    refuse("K2", K2, Dimension::stress, "a pressure K1 m + K2 m^2 + K3 m^3 that always grows with m");
  if (!(mu_lock > mu_crush)) refuse("mu lock", mu_lock, Dimension::none, "> mu crush");
  if (!(P_lock > P_crush)) refuse("Plock", P_lock, Dimension::stress, "> Pcrush");
  CrushCurve found = *this;
  found.find_lock();
  if (!(found.locked_modulus() >= elastic_modulus()))
    refuse("K1", K1, Dimension::stress, "stiffer without pores than before crushing, Pcrush / mu crush");
  if (!(found.crushing_modulus() <= elastic_modulus()))
    refuse("Plock", P_lock, Dimension::stress, "softer while it crushes than before, Pcrush / mu crush");
}

} // namespace spall
