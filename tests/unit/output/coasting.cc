// Tests of the criterion for a body that leaves a target without losing velocity any more.

#include "macro/output/coasting.h"

#include "macro/restart/byte_archives.h"

#include <gtest/gtest.h>

#include <functional>

namespace spall::test {
namespace {

constexpr double back = 0.1, radius = 0.01, length = 0.2, stretch = Coasting::stretch_radii * radius,
                 tail = back + length; // where the foremost point is when the tail leaves

/// Returns the motion of a body with its foremost point at a place.
BodyMotion at(double front, double speed) {
  return {.front = front, .rear = front - length, .velocity = {0, 0, speed}};
}

/// Moves a body from the front of the target on, and returns where its foremost point is when it coasts, or
/// when its tail has left.
double end_of(const std::function<double(double)>& speed_at) {
  Coasting coasting(back, radius);
  double front = 0;
  for (; front < tail && !coasting.coasts(); front += 1e-4) coasting.follow(at(front, speed_at(front)));
  return front;
}

TEST(Coasting, ABodyThatLosesNothingCoastsOneStretchBehindTheBack) {
  EXPECT_NEAR(end_of([](double) { return 100; }), back + stretch, 3e-4);
  EXPECT_NEAR(end_of([](double front) { return front < back + 0.02 ? 200 - 1000 * front : 80; }),
              back + 0.02 + stretch, 1e-3);
}

TEST(Coasting, APauseInsideTheTargetIsNoEnd) {
  EXPECT_GT(end_of([](double front) { return front < 0.03   ? 100
                                             : front < 0.09 ? 90
                                                            : 80; }),
            back + stretch - 1e-3);
}

TEST(Coasting, APauseShorterThanAStretchIsNoEnd) {
  const double pause = 0.9 * stretch;
  EXPECT_NEAR(end_of([&](double front) { return front < back + pause ? 100 : 99; }), back + pause + stretch,
              1e-3);
}

TEST(Coasting, ALossThatGoesOnCountsOverTheWholePathOfTheTail) {
  // Linear in the path: a rate that takes `part` of the velocity while the tail leaves.
  const auto rubbing = [](double part) {
    return end_of(
        [part](double front) { return front < back ? 100 : 100 * (1 - part * (front - back) / length); });
  };
  EXPECT_NEAR(rubbing(0.9 * Coasting::largest_change), back + stretch, 1e-3);
  // The loss that is left gets smaller with the path that is left.
  EXPECT_GT(rubbing(2 * Coasting::largest_change), back + stretch + 0.1 * length);
  EXPECT_NEAR(rubbing(20 * Coasting::largest_change), tail, stretch);
}

TEST(Coasting, ABodyThatStopsOrTurnsDoesNotCoast) {
  Coasting coasting(back, radius);
  for (double front = back; front < back + 2 * stretch; front += 1e-4) coasting.follow(at(front, 100));
  EXPECT_TRUE(coasting.coasts());
  coasting.follow(at(back + 2 * stretch, 0));
  EXPECT_FALSE(coasting.coasts());
  coasting.follow(at(back + 2 * stretch, -1));
  EXPECT_FALSE(coasting.coasts());
}

TEST(Coasting, GoesOnFromItsStateAsIfNothingHadHappened) {
  const auto speed_at = [](double front) { return front < back + 0.5 * stretch ? 200 - 1000 * front : 85; };
  Coasting whole(back, radius);
  for (double front = 0; front < tail; front += 1e-3) {
    whole.follow(at(front, speed_at(front)));
    ByteWriter writer;
    whole.transfer(writer);
    ByteReader reader(writer.bytes);
    Coasting resumed(back, radius);
    resumed.transfer(reader);
    reader.finish();
    EXPECT_EQ(resumed.coasts(), whole.coasts());
    EXPECT_EQ(resumed.end_of_stretch(), whole.end_of_stretch());
    whole = resumed;
  }
  EXPECT_TRUE(whole.coasts());
}

} // namespace
} // namespace spall::test
