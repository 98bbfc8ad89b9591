#include "measure/crossings.hpp"

#include <algorithm>

#include <bodice/engine/message.hpp>
#include <bodice/geometry/crossings.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

// The garment of a vertex of the joined mesh.
const WornGarment& garment_of(const Wardrobe& all, const std::vector<WornGarment>& garments,
                              geometry::Index vertex) {
  const auto next = std::ranges::upper_bound(all.first_vertex, vertex);
  return garments[static_cast<std::size_t>(next - all.first_vertex.begin()) - 1];
}

}  // namespace

std::size_t measure_crossings(const Wardrobe& all, const std::vector<WornGarment>& garments,
                              std::span<const geometry::Vec3> positions, const LabeledSkinView& skin,
                              std::vector<engine::Warning>& warnings) {
  const auto found = geometry::find_crossings(positions, all.mesh.triangles);
  if (found.empty()) return 0;
  const geometry::Triangle &s = all.mesh.triangles[found.front()[0]],
                           &t = all.mesh.triangles[found.front()[1]];
  const std::string &of_s = garment_of(all, garments, s[0]).name,
                    &of_t = garment_of(all, garments, t[0]).name;
  const geometry::SurfacePoint at = skin.distance.closest_point(positions[s[0]]);
  const body::Part part = skin.part[skin.mesh.triangles[at.triangle][0]];
  const std::string with = &of_s == &of_t ? "itself" : of_t;
  warnings.push_back(
      {"layers-cross", of_s,
       engine::message("At the end ", found.size(), " pairs of triangles cross. The first is of ", of_s,
                       " with ", with, ", near ", body::name(part), "."),
       "Give the order of the garments from the body outward (--order), if they cross at the start."});
  return found.size();
}

}  // namespace bodice::tryon
