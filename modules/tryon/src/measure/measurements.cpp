#include <bodice/tryon/measurements.hpp>

#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

namespace bodice::tryon {
namespace {

using Json = nlohmann::ordered_json;

/// In millimeters or degrees, to a hundredth.
double shown(const body::Measurements& measurements, body::MeasurementId id) {
  const double factor = is_angle(id) ? 180.0 / std::numbers::pi : 1e3;
  return std::round(measurements[id] * factor * 100.0) / 100.0;
}

Json as_json(const body::Measurements& measurements) {
  Json values = Json::object();
  for (int i = 0; i < body::kMeasurementCount; ++i) {
    const auto id = static_cast<body::MeasurementId>(i);
    const double value = shown(measurements, id);
    values[std::string(body::name(id))] = std::isfinite(value) ? Json(value) : Json();
  }
  return {{"units", {{"length", "mm"}, {"angle", "degree"}}}, {"body", values}};
}

}  // namespace

std::string measurements_json(const body::Measurements& measurements) {
  return as_json(measurements).dump(2) + "\n";
}

std::string measurements_yaml(const body::Measurements& measurements) {
  std::string text;
  const Json json = as_json(measurements);
  for (const auto& [group, members] : json.items()) {
    text += group + ":\n";
    for (const auto& [name, value] : members.items())
      text += "  " + name + ": " + (value.is_string() ? value.get<std::string>() : value.dump()) + "\n";
  }
  return text;
}

}  // namespace bodice::tryon
