#pragma once

#include "macro/shape/fill.h"
#include "shared/input/parameters.h"

#include <functional>
#include <string>

namespace spall {

/// The points that fill a body, as keys of its section of a scene file.
struct FillingInputs {
  Filling filling;

  void declare(Parameters& parameters, const std::string& section, const Needed& needed);
  /// @throws InputError as above
  void validate(const std::string& file, const std::string& section, const Shape& shape) const;

private:
  void validate_grading(const std::string& file, const std::string& section, const Cylinder& shape) const;
  void validate_cylinder(const std::string& file, const std::string& section, const Cylinder& shape) const;
  void validate_revolution(const std::string& file, const std::string& section, bool hollow) const;
  void validate_block(const std::string& file, const std::string& section) const;
  void validate_surface(const std::string& file, const std::string& section,
                        const ClosedSurface& shape) const;
};

} // namespace spall
