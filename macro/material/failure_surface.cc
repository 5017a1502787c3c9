#include "macro/material/failure_surface.h"

namespace spall {

void FailureSurface::declare(Parameters::Section& section) {
  const Range positive{above_zero}, not_negative{0};
  section.quantity("C1", C1, Dimension::stress, positive, "failure surface, Eq. 22");
  section.quantity("C2", C2, Dimension::stress, positive, "failure surface, Eq. 22");
  section.number("C3", C3, not_negative, "strain rate effect, Eq. 22");
  section.number("C4", C4, not_negative, "linear term of the failure surface, Eq. 22");
  section.quantity("C5", C5, Dimension::stress, positive, "largest principal stress difference");
  section.quantity("A_N", A_N, Dimension::inverse_stress, not_negative, "failure surface, Eq. 22");
  section.choice(
      "Invariant", invariant, {{"mean stress", Invariant::mean_stress}, {"trace", Invariant::trace}},
      "what I1 of Eqs. 22-24 and 30 means; T_max limits the mean stress with both: with trace the "
      "strength vanishes at a third of it already, and up to T_max a point carries mean tension alone");
  section.quantity("Rate floor", rate_floor, Dimension::rate, positive,
                   "smallest strain rate in 1 + C3 ln(rate s)");
  section.choice("C5 limits", bound,
                 {{"equivalent stress", StrengthBound::equivalent_stress},
                  {"principal difference", StrengthBound::principal_difference},
                  {"nothing", StrengthBound::nothing}},
                 "what C5 bounds: the strength as min(S, C5), the principal stress difference as printed, or "
                 "nothing");
  section.number("Lode eccentricity", lode_eccentricity, {0.5, 1},
                 "Willam-Warnke: strength in extension over compression at P = 0; 1 switches the effect off "
                 "(the paper prints no value)");
  section.quantity("Lode fading pressure", lode_fading, Dimension::stress, not_negative,
                   "where the eccentricity has risen to 1, linearly from P = 0 (8.45 times the uniaxial "
                   "compressive strength); 0: it does not rise");
  section.choice(
      "Lode range", lode_range,
      {{"everywhere", LodeRange::everywhere}, {"compression", LodeRange::compression}},
      "whether the Lode effect reduces the tensile surface as well, which keeps the two continuous, "
      "or Eq. 22 alone");
  section.choice(
      "Tension limits", tension_limit,
      {{"mean stress", TensionLimit::mean_stress},
       {"principal stress", TensionLimit::principal_stress},
       {"principal deviator", TensionLimit::principal_deviator}},
      "what T_max (1 - d_t) limits: the mean tension, as printed, or the largest principal stress as well, "
      "at any pressure; an open point meets that by losing stiffness in volume and shape alike, or in shape "
      "alone (principal deviator: cracks then open at constant volume and do not localise)");
  section.choice(
      "Shear damage acts in", shear_damage_side,
      {{"compression and tension", DamageSide::both}, {"compression", DamageSide::own}},
      "sides of P = 0 where shear damage takes the cohesion: both, as Eqs. 22 and 30 are printed, or "
      "compression alone");
  section.choice("Tensile damage acts in", tensile_damage_side,
                 {{"tension", DamageSide::own}, {"compression and tension", DamageSide::both}},
                 "tension: d_t takes the mean tension, as Eq. 30 is printed, and a cracked point has its "
                 "cohesion back under pressure; compression and tension: d_t takes the cohesion as well, on "
                 "both sides of P = 0");
}

} // namespace spall
