#pragma once

#include "shared/input/parameters.h"

namespace spall::test {

enum class Colour { red, green };

/// One key of every kind.
struct Sample {
  double length = required, factor = 0.5, extra = required;
  int count = 3;
  bool on = false;
  std::string name = "none", table;
  std::vector<double> sizes = {1e-3, 2e-3};
  std::vector<std::string> axes;
  Colour colour = Colour::red;
  Parameters parameters;

  Sample() {
    auto body = parameters.section("Body");
    body.quantity("Length", length, Dimension::length, {above_zero, 10}, "of the body");
    body.number("Factor", factor, {0, 1}, "of something");
    body.integer("Count", count, {1, 9}, "of things");
    body.flag("On", on, "or off");
    body.text("Name", name, "of the body");
    body.file("Table", table, "a path");
    body.quantities("Sizes", sizes, Dimension::length, {above_zero, 1}, "of cells");
    body.words("Axes", axes, {"x", "y"}, "of symmetry");
    const Choices<Colour> colours = {{"red", Colour::red}, {"green", Colour::green}};
    body.choice("Colour", colour, colours, "of the body");
    parameters.section("Extra", needed_if("Colour", colour, colours, {Colour::green}))
        .quantity("Mass", extra, Dimension::mass, {0, 1e9}, "needed if green");
  }
};

} // namespace spall::test
