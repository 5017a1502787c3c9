#pragma once

#include "macro/approximation/support.h"

#include <string>
#include <utility>
#include <vector>

namespace spall {

/// How the domain integral of the internal force is taken at the nodes.
enum class Scheme {
  dni,  ///< direct: gradient at the node. Has zero-energy modes; for comparison.
  snni, ///< smoothed over a non-conforming cell around the node (paper Eq. 10)
  nsni  ///< direct with natural stabilisation: the strain's first derivatives over the cell (Hillman and Chen
        ///< 2016)
};

/// The schemes by name: the one list of this room.
inline const std::vector<std::pair<std::string, Scheme>> scheme_names = {
    {"NSNI", Scheme::nsni}, {"SNNI", Scheme::snni}, {"DNI", Scheme::dni}};

inline const char* name_of(Scheme scheme) {
  std::size_t i = 0;
  while (scheme_names[i].second != scheme) ++i;
  return scheme_names[i].first.c_str();
}

/// True if the scheme carries derivatives of the gradient.
inline bool is_stabilized(Scheme scheme) { return scheme == Scheme::nsni; }

/// How far a scheme looks from the node, in support radii: smoothing evaluates shape functions on the faces
/// of the cell, half a spacing off the node.
inline double reach_of(Scheme scheme, double normalized_size) {
  return scheme == Scheme::snni ? 1 + 0.5 / normalized_size : 1;
}

struct IntegrationInputs {
  Scheme scheme = Scheme::nsni;
  /// Weight of the stabilisation; 1 would be the exact second moment of the cell with the material's tangent.
  double stabilization = 0.05;
  /// Most steps between rebuilding neighbours and shape functions, and the largest change of a neighbourhood
  /// (norm of the relative deformation minus identity) before that. Between refreshes the gradients are those
  /// of the last configuration, pushed forward. A refresh disturbs the balance of forces a little, and
  /// refreshes at a fixed rate feed saw-tooth modes: aluminium bar of the paper with 14 rings, L/L0 0.690
  /// with a refresh every 10 steps, 0.7025 every 5, 0.7045 every 2, 0.7050 with 6 refreshes in all by
  /// deformation (converged: 0.7040). Hence by deformation, unless bodies come apart and neighbours change.
  int refresh_interval = 1000;
  double refresh_deformation = 0.5;
};

} // namespace spall
