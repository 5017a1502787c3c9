#pragma once

#include "macro/approximation/support.h"

namespace spall {

/// How the domain integral of the internal force is taken at the nodes.
enum class Scheme {
  dni,  ///< direct: gradient at the node. Has zero-energy modes; for comparison.
  snni, ///< smoothed over a non-conforming cell around the node (paper Eq. 10)
  nsni  ///< direct with natural stabilisation: the strain's first derivatives over the cell (Hillman and Chen
        ///< 2016)
};

/// True if the scheme carries derivatives of the gradient.
inline bool is_stabilized(Scheme scheme) { return scheme == Scheme::nsni; }

struct IntegrationInputs {
  Scheme scheme = Scheme::nsni;
  /// Weight of the stabilisation; 1 would be the exact second moment of the cell with the material's tangent.
  double stabilization = 0.05;
  int refresh_interval = 10; ///< most steps between rebuilding neighbours and shape functions
  /// Largest change of a neighbourhood (norm of the relative deformation minus identity) before that.
  double refresh_deformation = 0.1;
};

} // namespace spall
