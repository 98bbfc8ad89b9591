// A body's measurements as text, in the form of GarmentCode's body files.
#pragma once

#include <string>

#include <bodice/body/measurement.hpp>

namespace bodice::inline v0_1::tryon {

/// The unit of the lengths in such a text. GarmentCode reads centimeters.
enum class TailorUnit { kMillimeter, kCentimeter };

/// A JSON object: `units` and under `body` each measurement by name, in the unit, to a hundredth of a
/// millimeter, or in degrees, to a hundredth; null where one could not be taken.
std::string measurements_json(const body::Measurements& measurements,
                              TailorUnit unit = TailorUnit::kMillimeter);

/// The same as YAML.
std::string measurements_yaml(const body::Measurements& measurements,
                              TailorUnit unit = TailorUnit::kMillimeter);

}  // namespace bodice::tryon
