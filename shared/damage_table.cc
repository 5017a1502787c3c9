#include "shared/damage_table.h"

#include "shared/error.h"
#include "shared/hdf5_file.h"
#include "shared/input/quantity.h"
#include "shared/output_directory.h"

#include <algorithm>
#include <cmath>

namespace spall {

const std::array<DamageColumn, 16> damage_columns = {{
    {"strain", "1", &DamageCurve::strain},
    {"stress", "Pa", &DamageCurve::stress},
    {"psi_bulk", "J/m3", &DamageCurve::psi_bulk},
    {"psi_cohesive", "J/m3", &DamageCurve::psi_cohesive},
    {"psi", "J/m3", &DamageCurve::psi},
    {"psi_undamaged", "J/m3", &DamageCurve::psi_undamaged},
    {"damage", "1", &DamageCurve::damage},
    {"damage_path", "1", &DamageCurve::damage_path},
    {"damage_strength", "1", &DamageCurve::damage_strength},
    {"damage_renormalised", "1", &DamageCurve::damage_renormalised},
    {"opening", "m", &DamageCurve::opening},
    {"dissipation", "J/m3", &DamageCurve::dissipation},
    {"work", "J/m3", &DamageCurve::work},
    {"psi_undamaged_plus", "J/m3", &DamageCurve::psi_undamaged_plus},
    {"psi_undamaged_minus", "J/m3", &DamageCurve::psi_undamaged_minus},
    {"damage_plus", "1", &DamageCurve::damage_plus},
}};

double DamageTable::oedometric_modulus() const {
  return youngs_modulus * (1 - poisson_ratio) / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
}

namespace {

/// Part of its largest value by which an energy may be negative, or a dissipation fall: what the iterations
/// of the microcell leave.
constexpr double rounding = 1e-3;

/// Round-off allowed before a damage counts as outside [0, 1] or decreasing.
constexpr double slack = 1e-9;

std::string format(double value) { return format_quantity(value, Dimension::none); }

/// Largest sizes of what a table holds: beyond them its squares and products leave the range of floating
/// point.
constexpr double largest_value = 1e15, largest_strain = 10;

/// What no cell that is pulled can have: all else depends on its loading.
void check_energies(const DamageCurve& curve, const std::string& where) {
  const auto peak_of = [](const std::vector<double>& values) {
    return std::max(*std::max_element(values.begin(), values.end()),
                    -*std::min_element(values.begin(), values.end()));
  };
  const auto refuse = [&](const char* column, std::size_t row, double found, const char* allowed) {
    throw InputError(where + ": column '" + column + "' row " + std::to_string(row) + " is " + format(found) +
                     ", allowed: " + allowed);
  };
  if (!(*std::max_element(curve.stress.begin(), curve.stress.end()) > 0))
    refuse("stress", curve.stress.size() - 1, curve.stress.back(),
           "above 0 somewhere: the cell carries nothing");
  for (const auto& [name, values] : {std::pair("psi", &curve.psi),
                                     {"psi_bulk", &curve.psi_bulk},
                                     {"psi_cohesive", &curve.psi_cohesive},
                                     {"psi_undamaged", &curve.psi_undamaged},
                                     {"opening", &curve.opening}}) {
    const double allowed = -rounding * peak_of(*values);
    for (std::size_t i = 0; i < values->size(); ++i)
      if ((*values)[i] < allowed) refuse(name, i, (*values)[i], ">= 0");
  }
  const double allowed = rounding * std::max(peak_of(curve.dissipation), peak_of(curve.psi));
  for (std::size_t i = 1; i < curve.dissipation.size(); ++i)
    if (curve.dissipation[i] < curve.dissipation[i - 1] - allowed)
      refuse("dissipation", i, curve.dissipation[i], "not less than in the row before");
}

void check_curve(const DamageCurve& curve, const std::string& where) {
  const auto refuse = [&](const std::string& what) { throw InputError(where + ": " + what); };
  for (const DamageColumn& column : damage_columns) {
    const std::vector<double>& values = curve.*column.values;
    if (values.size() != curve.strain.size() || values.size() < 3)
      refuse("column '" + std::string(column.name) + "' has " + std::to_string(values.size()) +
             " rows, expected " + std::to_string(std::max<std::size_t>(3, curve.strain.size())));
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(std::abs(values[i]) <= largest_value))
        refuse("column '" + std::string(column.name) + "' row " + std::to_string(i) +
               " is not a finite number of a size that cells have");
  }
  if (curve.strain.back() > largest_strain)
    refuse("column 'strain' ends at " + format(curve.strain.back()) + ", allowed: at most " +
           format(largest_strain));
  if (curve.strain[0] != 0) refuse("strain starts at " + format(curve.strain[0]) + ", expected 0");
  for (std::size_t i = 1; i < curve.strain.size(); ++i)
    if (!(curve.strain[i] > curve.strain[i - 1]))
      refuse("strain does not increase at row " + std::to_string(i));
  for (const DamageColumn& column : damage_columns) {
    if (column.values != &DamageCurve::damage && column.values != &DamageCurve::damage_strength &&
        column.values != &DamageCurve::damage_renormalised)
      continue;
    const std::vector<double>& values = curve.*column.values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] < -slack || values[i] > 1 + slack)
        refuse("column '" + std::string(column.name) + "' row " + std::to_string(i) + " is " +
               format(values[i]) + ", allowed: 0 to 1");
      if (i > 0 && values[i] < values[i - 1] - slack)
        refuse("column '" + std::string(column.name) + "' decreases at row " + std::to_string(i));
    }
  }
  check_energies(curve, where);
}

} // namespace

void check(const DamageTable& table, const std::string& where) {
  const auto refuse = [&](const std::string& what) { throw InputError(where + ": " + what); };
  const auto is_size = [](double value) { return value > 0 && value <= largest_value; };
  if (!is_size(table.youngs_modulus))
    refuse("Young's modulus is " + format(table.youngs_modulus) + " Pa, allowed: > 0 and finite");
  if (!(table.poisson_ratio > -1 && table.poisson_ratio < 0.5))
    refuse("Poisson's ratio is " + format(table.poisson_ratio) + ", allowed: -1 to 0.5");
  if (!is_size(table.tensile_strength)) refuse("tensile strength must be > 0 and finite");
  if (!is_size(table.fracture_energy)) refuse("fracture energy must be > 0 and finite");
  if (table.curves.empty()) refuse("holds no curve");
  double last = 0;
  for (const DamageCurve& curve : table.curves) {
    if (!(curve.cell_size > last && is_size(curve.cell_size)))
      refuse("cell sizes are not positive and ascending");
    last = curve.cell_size;
    if (!is_size(curve.relative_strength)) refuse("relative strength must be > 0 and finite");
    check_curve(curve, where + ": cell of " + format_quantity(curve.cell_size, Dimension::length));
  }
}

void write_damage_table(const DamageTable& table, const std::filesystem::path& target) {
  try {
    check(table, "damage table for '" + target.string() + "'");
  } catch (const InputError& error) { // it was computed: no input is to blame
    throw ComputationError(error.what());
  }
  // HDF5's own needs per group, array and attribute, generously.
  constexpr std::size_t overhead = 1 << 16;
  std::size_t bytes = overhead + table.provenance.input.size();
  for (const DamageCurve& curve : table.curves)
    bytes += overhead + damage_columns.size() * curve.strain.size() * sizeof(double);
  write_hdf5_atomically(target, bytes, [&](Hdf5File& file) {
    file.set_attribute("/", "format", std::string("spall damage table"));
    file.set_attribute("/", "format_version", DamageTable::format_version);
    file.set_attribute("/", "units", std::string("SI"));
    file.set_attribute("/", "youngs_modulus", table.youngs_modulus);
    file.set_attribute("/", "poisson_ratio", table.poisson_ratio);
    file.set_attribute("/", "tensile_strength", table.tensile_strength);
    file.set_attribute("/", "fracture_energy", table.fracture_energy);
    file.set_attribute("/", "softening", table.softening);
    file.set_attribute("/", "crack_set", table.crack_set);
    file.set_attribute("/", "boundary", table.boundary);
    file.set_attribute("/", "loading", table.loading);
    file.set_attribute("/", "program", table.provenance.program);
    file.set_attribute("/", "input_file", table.provenance.input_file);
    file.set_attribute("/", "created", table.provenance.created);
    file.set_attribute("/", "input", table.provenance.input);
    for (std::size_t i = 0; i < table.curves.size(); ++i) {
      const std::string group = "/curves/" + std::to_string(i);
      file.make_group(group);
      file.set_attribute(group, "cell_size", table.curves[i].cell_size);
      file.set_attribute(group, "relative_strength", table.curves[i].relative_strength);
      file.set_attribute(group, "psi_stress_error", table.curves[i].psi_stress_error);
      file.set_attribute(group, "psi_work_error", table.curves[i].psi_work_error);
      for (const DamageColumn& column : damage_columns) {
        const std::string path = group + "/" + column.name;
        file.write(path, table.curves[i].*column.values);
        file.set_attribute(path, "unit", std::string(column.unit));
      }
    }
  });
}

void write_damage_csv(const DamageTable& table, const std::filesystem::path& file) {
  std::string text = "# spall damage table, format " + std::to_string(DamageTable::format_version) + ", " +
                     table.provenance.program + ", " + table.provenance.created + "\n";
  text += "# E = " + format(table.youngs_modulus) + " Pa, nu = " + format(table.poisson_ratio) +
          ", f_t = " + format(table.tensile_strength) + " Pa, G_f = " + format(table.fracture_energy) +
          " N/m, " + table.softening + " softening, " + table.crack_set + ", " + table.boundary +
          " boundary, " + table.loading + "\n";
  text += "cell_size";
  for (const DamageColumn& column : damage_columns) text += std::string(",") + column.name;
  text += "\n";
  for (const DamageCurve& curve : table.curves)
    for (std::size_t row = 0; row < curve.strain.size(); ++row) {
      text += format(curve.cell_size);
      for (const DamageColumn& column : damage_columns) text += "," + format((curve.*column.values)[row]);
      text += "\n";
    }
  write_atomically(file, text);
}

DamageTable read_damage_table(const std::filesystem::path& path) {
  const std::string where = "damage table '" + path.string() + "'";
  DamageTable table;
  try {
    const Hdf5File file(path, Hdf5File::Mode::read);
    const int found = file.integer_attribute("/", "format_version");
    if (found != DamageTable::format_version)
      throw InputError(where + ": format version " + std::to_string(found) +
                       ", allowed: " + std::to_string(DamageTable::format_version) +
                       (found < DamageTable::format_version ? "; make the table anew with microcell" : ""));
    if (const std::string units = file.text_attribute("/", "units"); units != "SI")
      throw InputError(where + ": units '" + units + "', allowed: SI");
    table.youngs_modulus = file.real_attribute("/", "youngs_modulus");
    table.poisson_ratio = file.real_attribute("/", "poisson_ratio");
    table.tensile_strength = file.real_attribute("/", "tensile_strength");
    table.fracture_energy = file.real_attribute("/", "fracture_energy");
    table.softening = file.text_attribute("/", "softening");
    table.crack_set = file.text_attribute("/", "crack_set");
    table.boundary = file.text_attribute("/", "boundary");
    table.loading = file.text_attribute("/", "loading");
    table.provenance = {file.text_attribute("/", "program"), file.text_attribute("/", "input_file"),
                        file.text_attribute("/", "created"), file.text_attribute("/", "input")};
    const std::size_t count = file.list("/curves").size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::string group = "/curves/" + std::to_string(i);
      DamageCurve curve;
      curve.cell_size = file.real_attribute(group, "cell_size");
      curve.relative_strength = file.real_attribute(group, "relative_strength");
      curve.psi_stress_error = file.real_attribute(group, "psi_stress_error");
      curve.psi_work_error = file.real_attribute(group, "psi_work_error");
      for (const DamageColumn& column : damage_columns) {
        const std::string array = group + "/" + column.name;
        curve.*column.values = file.read<double>(array);
        if (const std::string unit = file.text_attribute(array, "unit"); unit != column.unit)
          throw InputError(where + ": column '" + column.name + "' is in '" + unit +
                           "', allowed: " + column.unit);
      }
      table.curves.push_back(std::move(curve));
    }
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(std::string("damage table ") + error.what());
  }
  check(table, where);
  return table;
}

void check_tension(const DamageTable& table, const std::string& where) {
  for (const DamageCurve& curve : table.curves) {
    const double share = curve.psi_undamaged_plus.back() / curve.psi_undamaged.back();
    if (!(share > 0.5))
      throw InputError(where + ": cell of " + format_quantity(curve.cell_size, Dimension::length) +
                       " under " + table.loading + ": found " + format(100 * share) +
                       " % of its elastic energy in tension, allowed: more than 50 %; make the table by "
                       "pulling the cell (microcell: Loading/Mode = uniaxial strain)");
  }
}

void check_elastic_constants(const DamageTable& table, double youngs_modulus, double poisson_ratio,
                             const std::string& where, double tolerance) {
  const auto refuse = [&](const std::string& what, double found, double wanted) {
    throw InputError(where + ": the damage table was made for " + what + " = " + format(found) +
                     ", the material has " + format(wanted) +
                     "; run microcell with the material's constants");
  };
  if (std::abs(table.youngs_modulus - youngs_modulus) > tolerance * youngs_modulus)
    refuse("Young's modulus (Pa)", table.youngs_modulus, youngs_modulus);
  if (std::abs(table.poisson_ratio - poisson_ratio) > tolerance)
    refuse("Poisson's ratio", table.poisson_ratio, poisson_ratio);
}

} // namespace spall
