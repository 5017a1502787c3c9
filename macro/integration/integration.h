#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Nodal integration of the internal force. Every scheme is a set of gradient
/// operators per point, which act on the same neighbours (see OperatorLayout).
enum class Scheme {
  dni,      ///< direct: gradient at the node. Has zero-energy modes; for comparison.
  snni,     ///< smoothed over a non-conforming cell around the node (paper Eq. 10)
  nsni,     ///< direct with natural stabilisation: the strain's first derivatives over the cell (Hillman and
            ///< Chen 2016)
  scni,     ///< smoothed over conforming cells (Chen et al. 2001); bodies that stay whole
  m_scni,   ///< SCNI stabilised by the strains of subcells (paper Eq. 11)
  m_snni,   ///< SNNI stabilised by the strains of subcells (paper Eq. 11)
  subpoint, ///< stress at sample points of the cell, each with its own history, one volume per node
};

/// The schemes by their names in input files: the only list of schemes in the folder.
inline const std::vector<std::pair<std::string, Scheme>> scheme_names = {
    {"NSNI", Scheme::nsni},        {"SNNI", Scheme::snni}, {"DNI", Scheme::dni},
    {"M-SNNI", Scheme::m_snni},    {"SCNI", Scheme::scni}, {"M-SCNI", Scheme::m_scni},
    {"SUBPOINT", Scheme::subpoint}};

inline const char* name_of(Scheme scheme) {
  std::size_t i = 0;
  while (scheme_names[i].second != scheme) ++i;
  return scheme_names[i].first.c_str();
}

/// Returns true if the smoothing cells fill the body; the scheme then needs ConformingCells and the
/// Lagrangian configuration.
inline bool is_conforming(Scheme scheme) { return scheme == Scheme::scni || scheme == Scheme::m_scni; }

/// Correction of the gradients, so that the nodal sums integrate them exactly.
enum class Correction {
  none,
  linear ///< a constant stress exerts no force on interior points, so that the linear patch test is passed
};
inline const std::vector<std::pair<std::string, Correction>> correction_names = {
    {"none", Correction::none}, {"linear", Correction::linear}};

struct IntegrationInputs {
  Scheme scheme = Scheme::nsni;
  /// Weight of the stabilisation (NSNI, M-): 1 would be the strain's variation over the cell with the
  /// material's tangent.
  double stabilization = 0.05;
  /// Sample points of the cell, 4, 6 or 8: K of M-SNNI's subcells (paper Eq. 11), or the sub-points.
  int subcells = 4;
  Correction correction = Correction::none;
  /// Rotational symmetry: y is the direction around the axis, along which nothing varies over the cell.
  /// make_solid() takes it from the symmetry of the scene.
  bool axisymmetric = false;
  /// Most steps between rebuilding neighbours and shape functions, and the largest change of a neighbourhood
  /// (norm of the relative deformation minus identity) before that. Between refreshes the gradients are those
  /// of the last configuration, pushed forward. A refresh disturbs the balance of forces a little, and
  /// refreshes at a fixed rate feed saw-tooth modes: aluminium bar of the paper with 14 rings, L/L0 0.690
  /// with a refresh every 10 steps, 0.7025 every 5, 0.7045 every 2, 0.7050 with 6 refreshes in all by
  /// deformation (converged: 0.7040). Hence by deformation, unless bodies come apart and neighbours change.
  int refresh_interval = 1000;
  double refresh_deformation = 0.5;
  /// Blocks of points whose |F - 1| has changed by less than this since their own last refresh keep their
  /// neighbours and shape functions when others are rebuilt (0: none do).
  double least_deformation = 0;
  int most_skipped = 10; ///< consecutive refreshes that a block may be left out of
};

/// The use of the gradient operators of a point.
enum class OperatorUse {
  gradient, ///< there is one, the gradient at the node
  moments,  ///< operator 0 is the gradient, operator m > 0 a difference D_m of gradients over the cell: it
           ///< adds volume * s_m : D_m to the power, with the rate of the stress moment s_m = stabilisation *
           ///< tangent : D_m
  subpoints ///< they are the gradients at sub-points that share the volume equally; the node's own gradient
            ///< is their mean
};

/// Storage of the gradient operators: those of one pair of points are side by side in a SIMD record.
struct OperatorLayout {
  OperatorUse use = OperatorUse::gradient;
  int count = 1; ///< operators per point
  int width = 1; ///< room for operators in a record: 1, 4 or 8; those beyond `count` are zero
};

/// The gradient operators of a scheme.
inline OperatorLayout layout_of(const IntegrationInputs& inputs) {
  const auto of = [](OperatorUse use, int count) {
    return OperatorLayout{use, count, count > 4 ? 8 : count > 1 ? 4 : 1};
  };
  switch (inputs.scheme) {
  case Scheme::dni:
  case Scheme::snni:
  case Scheme::scni:
    return of(OperatorUse::gradient, 1);
  case Scheme::nsni:
    return of(OperatorUse::moments, 4);
  // K subcells have K - 1 independent differences.
  case Scheme::m_snni:
  case Scheme::m_scni:
    return of(OperatorUse::moments, inputs.axisymmetric ? 4 : inputs.subcells);
  case Scheme::subpoint:
    return of(OperatorUse::subpoints, inputs.axisymmetric ? 4 : inputs.subcells);
  }
  return {};
}

/// Largest distance from the node, in support radii, at which a scheme finds neighbours: faces and samples of
/// the nodal cell are up to half a spacing off the node, faces of conforming cells up to one.
inline double reach_of(Scheme scheme, double normalized_size) {
  if (scheme == Scheme::dni || scheme == Scheme::nsni) return 1;
  return 1 + (is_conforming(scheme) ? 1 : 0.5) / normalized_size;
}

} // namespace spall
