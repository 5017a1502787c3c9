#include "macro/output/coasting.h"

#include <algorithm>

namespace spall {

void Coasting::follow(const BodyMotion& motion) {
  const double speed = motion.speed();
  front = motion.front;
  if (speed <= 0 || front <= back) { // before the back, or stopped or turned inside
    begun = false;
    return;
  }
  const auto begin_here = [&] { begun = true, begin = front, slowest = fastest = speed; };
  if (!begun) begin_here();
  slowest = std::min(slowest, speed), fastest = std::max(fastest, speed);
  const double tail_path = std::max(0.0, back - motion.rear), path = std::max(stretch, front - begin);
  if ((fastest - slowest) * tail_path > largest_change * speed * path) begin_here();
}

void Coasting::transfer(Archive& archive) {
  archive("coasting_begun", begun);
  for (double* part : {&front, &begin, &slowest, &fastest}) archive("coasting", *part);
}

} // namespace spall
