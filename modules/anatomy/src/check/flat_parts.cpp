#include "check/flat_parts.hpp"

#include <array>
#include <cmath>
#include <map>
#include <string>

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Vec3;

/// Cells of a normal's components from 0 to 1, and of a plane's distance from the middle, over the root of
/// the area: 4 degrees and 13 mm of a person.
constexpr double kNormalCells = 16.0, kOffsetCells = 100.0;
/// A plane counts from this share of the area on: a sole has .012.
constexpr double kPlane = 0.01;
/// A plane is a sole if its normal points down by at least this cosine.
constexpr double kSole = 0.9;
/// The number of triangles, evenly spread over the mesh, by which its planes are found.
constexpr std::size_t kPlaneTriangles = 100000;

}  // namespace

double flat_share(const geometry::TriMesh& skin, const Vec3& up) {
  const double root = std::sqrt(surface_area(skin));
  if (!(root > 0.0)) return 0.0;
  const Vec3 middle = geometry::bounding_box(skin.positions).center();
  const std::size_t step = 1 + skin.triangles.size() / kPlaneTriangles;
  std::map<std::array<long, 4>, double> area_of_plane;
  double area = 0.0, flat = 0.0;
  for (std::size_t t = 0; t < skin.triangles.size(); t += step) {
    const Vec3 vector = area_vector(skin, t);
    const double size = vector.norm();
    area += size;
    if (!(size > 0.0) || vector.dot(up) < -kSole * size) continue;
    const Vec3 normal = vector / size;
    std::array<long, 4> plane{};
    for (int k = 0; k < 3; ++k) plane[static_cast<std::size_t>(k)] = std::lround(kNormalCells * normal[k]);
    plane[3] = std::lround(kOffsetCells * (skin.corner(t, 0) - middle).dot(normal) / root);
    area_of_plane[plane] += size;
  }
  for (const auto& [plane, size] : area_of_plane)
    if (size > kPlane * area) flat += size / area;
  return flat;
}

void warn_of_flat_parts(const geometry::TriMesh& skin, Anatomy& anatomy) {
  const double flat = flat_share(skin, anatomy.up);
  if (flat <= kMostFlat) return;
  anatomy.warnings.push_back({"flat-parts", "",
                              std::to_string(std::lround(100.0 * flat)) +
                                  " % of the skin is flat: furniture, a floor or a pack may be part of it.",
                              "Cut off what is not the body, or check the parts around it."});
}

}  // namespace bodice::anatomy
