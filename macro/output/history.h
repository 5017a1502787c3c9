#pragma once

#include "macro/dynamics/simulation.h"
#include "shared/row_file.h"

#include <filesystem>
#include <limits>
#include <string>

namespace spall {

/// The bodies that the columns of history.csv are about.
struct HistorySubject {
  std::string moving; ///< body of the projectile_* columns; a body that is also `main` is followed by its
                      ///< centre of mass
  std::string main;   ///< deformable body that the contact force acts on
};

/// `history.csv`: one line per recorded step, SI, for whole bodies (sums of the modelled part times the
/// number of symmetric copies). Position and velocity are those of the foremost point of a projectile, or of
/// the centre of mass of a bar. The kinetic energy of the projectile is apart from that of all other points.
/// The internal energy is the sum of shear, compression and tension work (StressEnergy); of each, the elastic
/// part would be released by unloading, the rest is dissipated. A scene with reinforcing bars has columns for
/// their kinetic energy, the work of steel and bond (stored and dissipated), the number of segments that have
/// ruptured and of nodes without concrete around them, in the modelled part, and the largest slip (m). Every
/// body that can move has the columns NAME_x, NAME_y, NAME_z (m), the place of a rigid body's origin (the tip
/// of a projectile) or of a deformable one's centre of mass, and NAME_rotation_x, _y, _z (rad), the vector
/// along the axis of the rotation that turns it from its upright attitude, as long as the angle. A deformable
/// body's is that of its axis, by least squares: it does not tell a spin about it.
class History {
public:
  /// @param go_on leaves an older file as it is, until go_on() is called
  /// @param ranks of the run: all make the same calls, and the first writes
  History(const std::filesystem::path& directory, HistorySubject subject, bool go_on = false,
          const Ranks& ranks = {});
  /// One line for the present step, unless it has one already. @throws OutputError if it cannot be written;
  /// the file then ends with the line before
  void write(const Simulation& run);
  /// Loading changes no file. @throws InputError if lines of the run are gone
  void transfer(Archive& archive);
  /// After loading: cuts off what was written after the state was saved.
  void go_on();

private:
  std::filesystem::path path;
  HistorySubject subject;
  Ranks ranks;
  RowFile file;                  ///< of the first rank
  std::uint64_t saved_bytes = 0; ///< of the file, when the state was saved
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::size_t last_step = none; ///< step of the last line
};

/// Height of the centre of mass of the points, of all ranks if there are several, m.
double centre_of_mass(const Points& points, const Ranks& ranks = {});

} // namespace spall
