#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <bodice/engine/result.hpp>

namespace bodice::cloth {

/// Physical constants of a fabric; README.md of the module names the sources of the presets.
struct Fabric {
  std::string name;
  double density_kg_m2 = 0.15;
  double stretch_n_m = 1000.0;  ///< membrane stiffness, newtons a meter width
  double shear_n_m = 100.0;
  double bend_n_m = 1e-5;  ///< bending rigidity, newton meters
  double friction = 0.4;
  double damping_per_s = 0.5;
  double max_stretch = 0.05;  ///< strain limit
  /// Moment a meter of fold, in newtons, that the yarns' friction holds against bending and unbending.
  double bend_friction_n = 0.0;
};

/// The preset of this name; kNotFound lists the names there are.
engine::Result<Fabric> find_fabric(std::string_view name);
std::vector<std::string> fabric_names();

/// Fails with kInvalidArgument, naming the field, when a constant is not finite or out of range
/// (density, stretch > 0; the others >= 0).
engine::Result<void> check(const Fabric& fabric);

}  // namespace bodice::cloth
