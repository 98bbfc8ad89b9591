// Files of a body that fit writes beside its proxy.
#pragma once

#include <string>

#include <bodice/tryon/measurements.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::cli {

/// Measurements, JSON or YAML by the file's extension.
engine::Result<void> write_measurements(const tryon::SegmentedSkin& skin, tryon::TailorUnit unit,
                                        const std::string& file);

/// The vertices of the OBJ that the skin came from, by region.
engine::Result<void> write_segmentation(const engine::Context& context, const tryon::SegmentedSkin& skin,
                                        const std::string& file);

/// The skin in the colors of the proxy's errors, from the front and the side. Returns the error at which the
/// colors end, in meters.
engine::Result<double> write_heat_map(const engine::Context& context, const tryon::PreparedBody& body,
                                      const std::string& file);

}  // namespace bodice::cli
