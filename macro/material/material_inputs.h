#pragma once

#include "macro/material/materials.h"

namespace spall {

/// The material of a body as a file states it: `Material/Law` and, for each law, the section of its
/// constants. All names start with a prefix: "" in a material file of its own, "slab/" for the body slab.
struct MaterialInputs {
  std::size_t chosen = 0; ///< place in the list
  Laws laws;              ///< the constants of each

  MaterialInputs() = default;
  /// A material that a program states itself.
  template<MaterialLaw Law>
  MaterialInputs(const Law& law) : chosen(place_of<Law>(static_cast<Laws*>(nullptr))) {
    std::get<Law>(laws) = law;
  }

  /// Binds all keys; this must outlive `parameters`. `needed`: whether the constants of the chosen law must
  /// be set (default: always).
  void declare(Parameters& parameters, const std::string& prefix = "", Needed needed = {});
  /// Checks what no single key can. @param file the name of the input in messages. @throws InputError
  void validate(const std::string& file, const std::string& prefix = "") const;

  /// The chosen law with its constants, in the form that they choose. To be prepared for its points before
  /// use.
  Material material() const;
  std::string law() const;       ///< name of the chosen one
  double density() const;        ///< kg/m^3
  double youngs_modulus() const; ///< of the undamaged material, Pa
  double strength_limit() const; ///< largest stress difference it carries, Pa; may be infinite
  bool softens() const;          ///< whether damage takes its strength, so that strain localises
  bool ductile() const;          ///< whether it bends and flows where others break out of a face
  bool needs_spacing() const;    ///< whether it must know the spacing of its points
  Description describe() const;  ///< what it adds to the summary of a run

private:
  template<class Law, class... All> static constexpr std::size_t place_of(const std::tuple<All...>*) {
    std::size_t place = 0;
    (void)((std::is_same_v<Law, All> || (++place, false)) || ...);
    return place;
  }
};

} // namespace spall
