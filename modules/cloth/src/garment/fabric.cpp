// Fabric presets. Each constant lies inside the range published for its class of fabric; the value within the
// range is an order-of-magnitude choice.
// Based on: Sueo Kawabata. The Standardization and Analysis of Hand Evaluation. 1980. (KES-F measurements:
// tensile, shear G, bending B, and its hysteresis 2HB, which is twice the friction. 1 gf/(cm deg) = 56 N/m a
// radian, 1 gf cm^2/cm = 9.8e-5 N m, 1 gf cm/cm = 9.8e-3 N)
#include <array>
#include <cmath>

#include <bodice/cloth/fabric.hpp>

namespace bodice::inline v0_1::cloth {
namespace {

//                        kg/m2  stretch  shear  bend    friction damping limit bend friction
const Fabric kPresets[] = {
    {"cotton", 0.140, 3000.0, 60.0, 8.0e-6, 0.45, 0.5, 0.04, 2.0e-4},
    {"silk", 0.065, 2500.0, 20.0, 2.0e-6, 0.30, 0.4, 0.04, 5.0e-5},
    {"denim", 0.400, 8000.0, 160.0, 8.0e-5, 0.50, 0.8, 0.03, 2.0e-3},
    {"jersey", 0.180, 400.0, 40.0, 2.0e-6, 0.45, 0.8, 0.25, 1.0e-4},
    {"leather", 0.700, 12000.0, 600.0, 3.0e-4, 0.55, 1.2, 0.03, 6.0e-3},
};

}  // namespace

std::vector<std::string> fabric_names() {
  std::vector<std::string> names;
  for (const Fabric& fabric : kPresets) names.push_back(fabric.name);
  return names;
}

engine::Result<Fabric> find_fabric(std::string_view name) {
  std::string known;
  for (const Fabric& fabric : kPresets) {
    if (fabric.name == name) return fabric;
    known += (known.empty() ? "" : ", ") + fabric.name;
  }
  return engine::Error{engine::ErrorCode::kNotFound, "There is no fabric named '" + std::string(name) + "'.",
                       "Choose one of " + known + ", or fill in a cloth::Fabric."};
}

engine::Result<void> check(const Fabric& fabric) {
  struct Field {
    const char* name;
    double value;
    bool positive;
  };
  const std::array fields = {Field{"density_kg_m2", fabric.density_kg_m2, true},
                             Field{"stretch_n_m", fabric.stretch_n_m, true},
                             Field{"shear_n_m", fabric.shear_n_m, false},
                             Field{"bend_n_m", fabric.bend_n_m, false},
                             Field{"friction", fabric.friction, false},
                             Field{"damping_per_s", fabric.damping_per_s, false},
                             Field{"max_stretch", fabric.max_stretch, false},
                             Field{"bend_friction_n", fabric.bend_friction_n, false}};
  for (const Field& field : fields) {
    if (std::isfinite(field.value) && (field.positive ? field.value > 0.0 : field.value >= 0.0)) continue;
    return engine::Error{
        engine::ErrorCode::kInvalidArgument,
        "Fabric '" + fabric.name + "': " + field.name + " is " + std::to_string(field.value) + ".",
        field.positive ? "Give a finite value above zero." : "Give a finite value, zero or more."};
  }
  return {};
}

}  // namespace bodice::cloth
