#include "macro/material/material_inputs.h"

namespace spall {
namespace {

/// Calls f(law, its place) for each law of the list.
template<class List, class F> void for_each_law(List& laws, F f) {
  std::size_t place = 0;
  std::apply([&](auto&... law) { (f(law, place++), ...); }, laws);
}

/// The form that the constants of a law choose.
template<class Law> Material form_of(const Law& law) { return law; }
Material form_of(const Afc& law) {
  if (law.crack_model == CrackModel::isotropic) return law;
  return OrientedAfc(law);
}

} // namespace

void MaterialInputs::declare(Parameters& parameters, const std::string& prefix, Needed needed) {
  std::vector<std::pair<std::string, std::size_t>> names;
  for_each_law(laws, [&](const auto& law, std::size_t place) { names.emplace_back(law.name, place); });
  parameters.section(prefix + "Material", needed)
      .choice("Law", chosen, names, "constitutive law; its constants are in the section of that name");
  for_each_law(laws, [&](auto& law, std::size_t place) {
    law.declare(parameters,
                Needed{[this, place] { return chosen == place; }, std::string("Law = ") + law.name} && needed,
                prefix + law.name);
  });
}

void MaterialInputs::validate(const std::string& file, const std::string& prefix) const {
  std::visit([&](const auto& law) { law.validate(file, prefix + law.name); }, material());
}

Material MaterialInputs::material() const {
  Material material;
  for_each_law(laws, [&](const auto& law, std::size_t place) {
    if (place == chosen) material = form_of(law);
  });
  return material;
}

std::string MaterialInputs::law() const {
  return std::visit([](const auto& law) -> std::string { return law.name; }, material());
}
double MaterialInputs::density() const {
  return std::visit([](const auto& law) { return law.density; }, material());
}
double MaterialInputs::youngs_modulus() const {
  return std::visit(
      [](const auto& law) { return youngs_modulus_of(law.bulk_modulus(), law.shear_modulus()); }, material());
}
double MaterialInputs::strength_limit() const {
  return std::visit([](const auto& law) { return law.strength_limit(); }, material());
}
bool MaterialInputs::softens() const {
  return std::visit([](const auto& law) { return law.softens(); }, material());
}
bool MaterialInputs::ductile() const {
  return std::visit([](const auto& law) { return law.ductile; }, material());
}
bool MaterialInputs::needs_spacing() const {
  return std::visit([](const auto& law) { return law.needs_spacing(); }, material());
}
Description MaterialInputs::describe() const {
  return std::visit([](const auto& law) { return law.describe(); }, material());
}

} // namespace spall
