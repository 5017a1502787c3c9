#include "macro/dynamics/health.h"

#include "shared/traffic.h"

#include "shared/input/quantity.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Beyond these the run warns, once. Worst of the paper's aluminium bar with NSNI, SNNI, DNI: plastic strain
/// 0.014, 0.054, 0.089; mismatch of volumes 0.005, 0.15, 0.23 (1 % of volume is 220 MPa of pressure in
/// concrete). Energy: sound runs keep it to 0.3 %. Dissipation: it falls by 2e-5 of the initial energy or
/// less in the 38 runs of data/studies/slab_layouts.prm, as moments give back what they have stored.
constexpr double rough_strain = 0.03, rough_volume = 0.02, rough_energy = 0.01, rough_dissipation = 0.01;
/// Part of the step asked for below which a run costs twice what was planned.
constexpr double short_step = 0.5;

/// The larger magnitude; one that is not a number counts as the largest.
double worse(double a, double b) { return std::isnan(a) || std::abs(b) <= std::abs(a) ? a : b; }

} // namespace

void Health::note(const RefreshReport& refresh) {
  ++refreshes;
  refreshed_points += refresh.rebuilt;
  most_regularized = std::max(most_regularized, refresh.regularized);
  most_isolated = std::max(most_isolated, refresh.isolated);
  smallest_moment_fraction = std::min(smallest_moment_fraction, refresh.smallest_fraction);
}

void Health::look(const Bodies& bodies, double time) {
  const TrafficOf use(MpiUse::looks);
  hourglass.resize(bodies.solids.size());
  for (std::size_t s = 0; s < bodies.solids.size(); ++s) {
    const HourglassIndicators now = bodies.solids[s]->hourglass_indicators();
    HourglassIndicators& worst = hourglass[s];
    worst.plastic_saw_tooth = worse(worst.plastic_saw_tooth, now.plastic_saw_tooth);
    worst.position_saw_tooth = worse(worst.position_saw_tooth, now.position_saw_tooth);
    worst.volume_alternation = worse(worst.volume_alternation, now.volume_alternation);
    worst.volume_mismatch = worse(worst.volume_mismatch, now.volume_mismatch);
    const std::string where = bodies.solids.size() > 1 ? bodies.solids[s]->label + ": " : "";
    if (!(now.plastic_saw_tooth <= rough_strain))
      warn(&Said::strain,
           where + "plastic strain alternates from point to point (rms " +
               std::to_string(now.plastic_saw_tooth) + "): the integration scheme is not stable enough here",
           time);
    if (!(std::abs(now.volume_mismatch) <= rough_volume))
      warn(&Said::volume,
           where + "the volume between the points differs from the integrated one by " +
               std::to_string(100 * now.volume_mismatch) + " % on average",
           time);
  }
}

void Health::note_energy_error(double error, double time) {
  largest_energy_error = worse(largest_energy_error, std::abs(error));
  if (!(largest_energy_error <= rough_energy))
    warn(&Said::energy, "the energy error has grown to " + in_six_digits(100 * error) + " %", time);
}

void Health::note_dissipated(double dissipated, double initial, double time) {
  if (!(initial > 0)) return;
  most_dissipated = std::max(most_dissipated, dissipated);
  energy_created = worse(energy_created, (most_dissipated - dissipated) / initial);
  if (!(energy_created <= rough_dissipation))
    warn(&Said::created,
         "the materials have created " + in_six_digits(100 * energy_created) +
             " % of the initial energy: their stresses have done work that nothing had stored",
         time);
}

void Health::note_short_step(double factor, double asked, double time) {
  ++step_reductions;
  if (factor >= short_step * asked) return;
  warn(&Said::step,
       "steps are shortened from " + in_six_digits(asked) + " (Time/Step factor) to " +
           in_six_digits(factor) + " h / c, as the stiffness demands: the run takes longer than planned",
       time);
}

void Health::warn(bool Said::*about, const std::string& text, double time) {
  if (said.*about) return;
  said.*about = true;
  warnings.push_back("t = " + in_six_digits(time * 1e6) + " us: " + text);
}

void Health::transfer(Archive& archive) {
  std::uint64_t looked_at = hourglass.size();
  archive("looked_at", looked_at);
  hourglass.resize(looked_at);
  archive("hourglass", hourglass);
  for (std::size_t* count :
       {&step_reductions, &refreshes, &refreshed_points, &most_regularized, &most_isolated})
    archive("counts", *count);
  for (double* extreme : {&smallest_step_margin, &smallest_moment_fraction, &largest_energy_error,
                          &most_dissipated, &energy_created})
    archive("extremes", *extreme);
  archive("warnings", warnings);
  archive("said", said);
}

} // namespace spall
