#include <bodice/engine/json.hpp>
#include <bodice/tryon/measurements.hpp>

#include <cmath>
#include <numbers>

namespace bodice::inline v0_1::tryon {
namespace {

using engine::Json;

struct LengthUnit {
  const char* name;
  double in_a_meter, digits;  ///< units in a meter, and steps in a unit to which values are rounded
};
constexpr LengthUnit kMillimeters = {"mm", 1e3, 100.0}, kCentimeters = {"cm", 1e2, 1000.0};

const LengthUnit& length_unit(TailorUnit unit) {
  return unit == TailorUnit::kMillimeter ? kMillimeters : kCentimeters;
}

/// The value in the unit, to a hundredth of a millimeter, or in degrees.
double shown(const body::Measurements& measurements, body::MeasurementId id, const LengthUnit& unit) {
  if (is_angle(id)) return std::round(measurements[id] * 180.0 / std::numbers::pi * 100.0) / 100.0;
  return std::round(measurements[id] * unit.in_a_meter * unit.digits) / unit.digits;
}

Json as_json(const body::Measurements& measurements, const LengthUnit& unit) {
  Json values = Json::object();
  for (int i = 0; i < body::kMeasurementCount; ++i) {
    const auto id = static_cast<body::MeasurementId>(i);
    const double value = shown(measurements, id, unit);
    values[std::string(body::name(id))] = std::isfinite(value) ? Json(value) : Json();
  }
  return {{"units", {{"length", unit.name}, {"angle", "degree"}}}, {"body", values}};
}

}  // namespace

std::string measurements_json(const body::Measurements& measurements, TailorUnit unit) {
  return as_json(measurements, length_unit(unit)).dump({.indent = 2}) + "\n";
}

std::string measurements_yaml(const body::Measurements& measurements, TailorUnit unit) {
  std::string text;
  const Json json = as_json(measurements, length_unit(unit));
  for (const auto& [group, members] : json.items()) {
    text += group + ":\n";
    for (const auto& [name, value] : members.items())
      text += "  " + name + ": " + (value.is_string() ? value.get<std::string>() : value.dump()) + "\n";
  }
  return text;
}

}  // namespace bodice::tryon
