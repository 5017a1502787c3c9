#pragma once

#include "shared/provenance.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace spall {

/// Response of one microcell of one size in uniaxial strain. All columns have the same length; row 0 is the
/// unloaded cell. SI units.
struct DamageCurve {
  double cell_size = 0; ///< edge l of the cell, m
  /// Peak stress of a weak or strong curve over that of the ensemble's mean curve; 1 for all other curves.
  /// The macroscopic model multiplies its tensile strength by it.
  double relative_strength = 1;
  /// Largest differences over all rows between psi, integrated over bulk and cracks, and stress * strain / 2,
  /// and work - dissipation, in units of the largest psi.
  double psi_stress_error = 0, psi_work_error = 0;
  std::vector<double> strain;        ///< macroscopic strain, strictly increasing from 0
  std::vector<double> stress;        ///< homogenised stress along the tension axis, Pa
  std::vector<double> psi_bulk;      ///< elastic energy of the bulk per volume, J/m^3 (Eq. 26, first term)
  std::vector<double> psi_cohesive;  ///< half traction times opening per volume, J/m^3 (Eq. 26, second term)
  std::vector<double> psi;           ///< homogenised free energy, J/m^3 (Eq. 26)
  std::vector<double> psi_undamaged; ///< energy of the uncracked cell at this strain, Y of Eq. 28, J/m^3
  std::vector<double> damage;        ///< secant 1 - psi / Y (Eq. 27 with Eq. 29 at frozen cracks)
  std::vector<double> damage_path;   ///< 1 - d psi / d Y along the path (Eq. 29 as a finite difference)
  std::vector<double> damage_strength;     ///< 1 - stress / peak stress after the peak, 0 before
  std::vector<double> damage_renormalised; ///< 1 - (1 - damage) / (1 - damage(0))
  std::vector<double> opening;             ///< largest crack opening, m
  std::vector<double> dissipation;         ///< energy dissipated so far per volume, J/m^3
  std::vector<double> work;                ///< work of the macroscopic stress so far per volume, J/m^3
  /// Psi0+ and Psi0- of Eq. 28: psi_undamaged split by the signs of the principal strains and of the volume
  /// change, J/m^3.
  std::vector<double> psi_undamaged_plus, psi_undamaged_minus;
  /// Damage d of the tensile part of the energy: psi = (1 - d) Psi0+ + Psi0- (Eq. 28).
  std::vector<double> damage_plus;
};

/// One column of a curve: its name in files, its unit and its member in DamageCurve.
struct DamageColumn {
  const char* name;
  const char* unit;
  std::vector<double> DamageCurve::*values;
};
/// All columns in the order of the `.csv` files. New columns may be added only at the end.
extern const std::array<DamageColumn, 16> damage_columns;

/// The data that microcell passes to penetrate: one curve per cell size and the constants that they belong
/// to.
struct DamageTable {
  static constexpr int format_version = 2;
  double youngs_modulus = 0;   ///< Young's modulus of the uncracked cell, Pa
  double poisson_ratio = 0;    ///< Poisson's ratio of the uncracked cell
  double tensile_strength = 0; ///< tensile strength f_t of the cohesive law, Pa
  double fracture_energy = 0;  ///< fracture energy G_f of the cohesive law, N/m
  std::string softening;       ///< "linear", ...
  std::string crack_set;       ///< description such as "one centred crack, 2 a0 / l = 0.25"
  std::string boundary;        ///< "periodic", ...
  std::string loading = "uniaxial strain";
  Provenance provenance;
  std::vector<DamageCurve> curves; ///< curves in ascending order of cell size

  /// Returns the modulus of uniaxial strain, Pa: E (1 - nu) / ((1 + nu)(1 - 2 nu)).
  double oedometric_modulus() const;
};

/// Throws InputError, naming `where` and the first error: no curve, columns of unequal length or fewer
/// than three rows, NaN, strain not strictly increasing from 0, a damage outside [0, 1] or decreasing (except
/// the path derivative and damage_plus, which the macroscopic model does not use), sizes not ascending,
/// constants out of range.
void check(const DamageTable& table, const std::string& where);

/// Checks the table, then writes it atomically. @throws ComputationError with what check() says, OutputError
/// if the disk is full.
void write_damage_table(const DamageTable& table, const std::filesystem::path& file);

/// Writes the same data as `.csv` for users: comment lines with the constants, then `cell_size` and every
/// column.
void write_damage_csv(const DamageTable& table, const std::filesystem::path& file);

/// Reads and checks a table. @throws InputError for a missing or truncated file, another version, arrays with
/// a wrong number of dimensions, units other than SI, and everything that check() refuses.
DamageTable read_damage_table(const std::filesystem::path& file);

/// Throws InputError unless the cells were pulled: at the last row more than half of the energy of the
/// uncracked cell must be tension (psi_undamaged_plus). A cell that was pressed or sheared says nothing about
/// d_t.
void check_tension(const DamageTable& table, const std::string& where);

/// Throws InputError unless E and nu agree with the material's within `tolerance` (relative; absolute for
/// nu).
void check_elastic_constants(const DamageTable& table, double youngs_modulus, double poisson_ratio,
                             const std::string& where, double tolerance = 2e-3);

} // namespace spall
