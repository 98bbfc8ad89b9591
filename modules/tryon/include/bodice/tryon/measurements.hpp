// A body's measurements as text, in the form of GarmentCode's body files.
#pragma once

#include <string>

#include <bodice/body/measurement.hpp>

namespace bodice::tryon {

/// A JSON object: `units` and under `body` each measurement by name, in millimeters or degrees, to a
/// hundredth; null where one could not be taken.
std::string measurements_json(const body::Measurements& measurements);

/// The same as YAML in centimeters, which GarmentCode reads as it stands.
std::string measurements_yaml(const body::Measurements& measurements);

}  // namespace bodice::tryon
