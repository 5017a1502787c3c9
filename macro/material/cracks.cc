#include "macro/material/cracks.h"

namespace spall {

void Cracks::declare(Parameters::Section& section) {
  section.choice(
      "Opening", opening, {{"cracks", Opening::cracks}, {"cut-off", Opening::cut_off}},
      "a point pulled beyond T_max loses stiffness and closes along the secant; or its pressure is "
      "cut off, its volume closes along the line on which it opened and its deviator stays, which "
      "gives back what opening has cost (for verification against programs that do so)");
  section.number(
      "Opened volume kept", opened_kept, {0, 1},
      "part of the volume opened beyond the tension cut-off, and of the change of shape beyond the "
      "strength in tension, that stays: 0 closes before pressure returns, as a crack does; 1 stays, "
      "as in rubble that no longer fits");
  section.number("Crack dilatancy", dilatancy, {0},
                 "opening over slip where a rough crack that has slipped touches again: so much of what has "
                 "opened stays; 0: slip keeps nothing open");
}

} // namespace spall
