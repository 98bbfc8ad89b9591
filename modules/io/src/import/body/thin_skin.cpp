#include "import/body/thin_skin.hpp"

#include <cmath>
#include <string>
#include <utility>

#include <bodice/geometry/thin.hpp>

namespace bodice::inline v0_1::io {
namespace {

using geometry::Index;
using geometry::kNoIndex;

/// Skins of more vertices are thinned, to about as many as the other number.
constexpr std::size_t kMany = 300'000;
constexpr double kEnough = 200'000.0;
/// Shortest edge of a thinned skin over the edge of as many equilateral triangles with its area.
constexpr double kShortest = 0.6;
/// How far off the skin may be, as a fraction of its longest side: .1 mm of a person.
constexpr double kTolerance = 6e-5;

}  // namespace

bool is_overfine(const geometry::TriMesh& skin) {
  return skin.positions.size() > kMany;
}

engine::Warning thin_skin(const engine::Context& context, const geometry::RoughSurface& surface, double noise,
                          geometry::RepairedMesh& skin) {
  const std::size_t before = skin.mesh.positions.size();
  const double longest = geometry::bounding_box(skin.mesh.positions).size().maxCoeff();
  const double edge = std::sqrt(surface_area(skin.mesh) / (kEnough * 0.5 * std::sqrt(3.0)));
  const geometry::ThinOptions options{.edge_m = kShortest * edge, .tolerance_m = kTolerance * longest};
  geometry::ThinnedSurface thinned =
      noise > 0.0 ? thin_noisy(context, surface, noise, options) : thin(context, skin.mesh, options);
  for (Index& v : skin.vertex_of_input)
    if (v != kNoIndex) v = thinned.vertex_of_input[v];
  for (Index& t : skin.triangle_of_input)
    if (t != kNoIndex) t = thinned.triangle_of_input[t];
  skin.mesh = std::move(thinned.mesh);
  return engine::note("skin-thinned", "",
                      "The file has a skin of " + std::to_string(before) +
                          " vertices, which was thinned to " + std::to_string(skin.mesh.positions.size()) +
                          "; accuracy counts from these.",
                      "To fit all of them, keep them (program: --keep-vertices).");
}

}  // namespace bodice::io
