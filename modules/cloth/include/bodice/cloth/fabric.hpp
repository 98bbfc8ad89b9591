// Physical constants of cloth.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::cloth {

/// Physical constants of a fabric. modules/cloth/README.md states the sources of the presets.
struct Fabric {
  std::string name;
  double density_kg_m2 = 0.15;  ///< mass a square meter
  double stretch_n_m = 1000.0;  ///< membrane stiffness, newtons a meter of width
  double shear_n_m = 100.0;     ///< shear stiffness, newtons a meter
  double bend_n_m = 1e-5;       ///< bending rigidity, newton meters
  double friction = 0.4;        ///< Coulomb coefficient, against the body and between layers
  double damping_per_s = 0.5;   ///< velocities decay as exp(-damping t)
  double max_stretch = 0.05;    ///< strain limit: beyond this elongation edges are rigid
  /// Friction between yarns: the moment a meter of fold, in newtons, that resists bending and unbending.
  double bend_friction_n = 0.0;
};

/// The preset of this name. Fails with kNotFound; the remedy lists the names.
engine::Result<Fabric> find_fabric(std::string_view name);
/// The names of all presets.
std::vector<std::string> fabric_names();

/// Fails with kInvalidArgument, naming the field, if a constant is not finite or out of range: density and
/// stretch are above 0, the others at least 0.
engine::Result<void> check(const Fabric& fabric);

}  // namespace bodice::cloth
