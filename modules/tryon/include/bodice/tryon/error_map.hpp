// The error of a proxy over the skin, as colors to look at.
#pragma once

#include <array>
#include <vector>

#include <bodice/io/scene.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// Errors of the vertices of a skin, and colors for them.
struct ErrorMap {
  std::vector<double> error_m;  ///< #V: signed distance to the proxy, positive outside of it
  double limit_m = 0.0;         ///< error at which the colors end; 98 % of the vertices have a smaller one
  std::vector<std::array<float, 3>> colors;  ///< #V, sRGB: blue inside the proxy, white on it, red outside
};

/// The colors of the map in millimeters, for a picture of it.
io::Legend legend_of(const ErrorMap& map);

/// Cost: one exact distance a vertex.
ErrorMap error_map(const engine::Context& context, const PreparedBody& body);

}  // namespace bodice::tryon
