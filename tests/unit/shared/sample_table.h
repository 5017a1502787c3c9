#pragma once

#include "shared/damage_table.h"
#include "shared/hdf5_file.h"

#include <algorithm>
#include <functional>

namespace spall::test {

/// Makes a table in closed form: a cell of edge l with one crack that opens by w = w_f (1 - stress / f) after
/// the stress has reached f, with w_f = 2 G_f / f. Every column follows from the energies of a linear elastic
/// bar with that crack.
inline DamageTable cracking_bar(const std::vector<double>& sizes, int rows = 40) {
  DamageTable table;
  table.youngs_modulus = 18727e6;
  table.poisson_ratio = 0.3585;
  table.tensile_strength = 3e6;
  table.fracture_energy = 80;
  table.softening = "linear";
  table.crack_set = "one crack across the cell";
  table.boundary = "periodic";
  table.provenance = {"microcell test", "bar.prm", "2020-01-01T00:00:00Z", "set A = 1\nset B = \"2\"\n"};
  const double E = table.oedometric_modulus(), f = table.tensile_strength, G = table.fracture_energy,
               full_opening = 2 * G / f;
  for (const double l : sizes) {
    DamageCurve c;
    c.cell_size = l;
    const auto add = [&](double stress, double opening) {
      const double strain = stress / E + opening / l, bulk = 0.5 * stress * stress / E,
                   cohesive = 0.5 * stress * opening / l, undamaged = 0.5 * E * strain * strain,
                   work = bulk + (opening > 0 ? 0.5 * (f + stress) * opening / l : 0);
      const double damage = strain > 0 ? std::max(0.0, 1 - (bulk + cohesive) / undamaged) : 0;
      c.strain.push_back(strain);
      c.stress.push_back(stress);
      c.psi_bulk.push_back(bulk);
      c.psi_cohesive.push_back(cohesive);
      c.psi.push_back(bulk + cohesive);
      c.psi_undamaged.push_back(undamaged);
      c.damage.push_back(damage);
      c.damage_path.push_back(1.5 * damage); // the path derivative exceeds 1
      c.damage_strength.push_back(opening > 0 ? 1 - stress / f : 0);
      c.damage_renormalised.push_back(damage);
      c.opening.push_back(opening);
      c.dissipation.push_back(work - bulk - cohesive);
      c.work.push_back(work);
      c.psi_undamaged_plus.push_back(undamaged);
      c.psi_undamaged_minus.push_back(0);
      c.damage_plus.push_back(damage);
    };
    add(0, 0);
    for (int i = 0; i <= rows; ++i) add(f * (1 - 1. * i / rows), full_opening * i / rows);
    table.curves.push_back(c);
  }
  return table;
}

/// Writes a table column by column as the format is documented, without any check. `column` may change
/// or skip (return false) a column of the first curve before it is written.
struct RawWriter {
  int version = DamageTable::format_version;
  std::string units = "SI";
  std::string skipped_attribute;
  struct Column {
    std::string name, unit;
    std::vector<double> values;
    std::size_t columns = 1;
  };
  std::function<bool(Column&)> column = [](Column&) { return true; };

  void operator()(const DamageTable& t, const std::filesystem::path& path) const {
    Hdf5File file(path, Hdf5File::Mode::create);
    file.set_attribute("/", "format_version", version);
    file.set_attribute("/", "units", units);
    const std::vector<std::pair<std::string, double>> numbers = {{"youngs_modulus", t.youngs_modulus},
                                                                 {"poisson_ratio", t.poisson_ratio},
                                                                 {"tensile_strength", t.tensile_strength},
                                                                 {"fracture_energy", t.fracture_energy}};
    for (const auto& [name, value] : numbers)
      if (name != skipped_attribute) file.set_attribute("/", name, value);
    const std::vector<std::pair<std::string, std::string>> texts = {
        {"softening", t.softening},        {"crack_set", t.crack_set},
        {"boundary", t.boundary},          {"loading", t.loading},
        {"program", t.provenance.program}, {"input_file", t.provenance.input_file},
        {"created", t.provenance.created}, {"input", t.provenance.input}};
    for (const auto& [name, value] : texts)
      if (name != skipped_attribute) file.set_attribute("/", name, value);
    for (std::size_t i = 0; i < t.curves.size(); ++i) {
      const std::string group = "/curves/" + std::to_string(i);
      file.make_group(group);
      file.set_attribute(group, "cell_size", t.curves[i].cell_size);
      file.set_attribute(group, "relative_strength", t.curves[i].relative_strength);
      file.set_attribute(group, "psi_stress_error", t.curves[i].psi_stress_error);
      file.set_attribute(group, "psi_work_error", t.curves[i].psi_work_error);
      for (const DamageColumn& c : damage_columns) {
        Column written{c.name, c.unit, t.curves[i].*c.values};
        if (i == 0 && !column(written)) continue;
        file.write(group + "/" + c.name, written.values, written.columns);
        file.set_attribute(group + "/" + c.name, "unit", written.unit);
      }
    }
    file.close();
  }
};

} // namespace spall::test
