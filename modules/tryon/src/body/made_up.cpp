#include "body/made_up.hpp"

#include <algorithm>
#include <limits>
#include <string>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

/// Skin this much farther from a landmark than the nearest skin is around it; a fraction of the stature.
constexpr double kAround = 0.03;
/// A landmark is made up with the skin where so much of that is.
constexpr double kMostly = 0.5;
/// Landmarks from here on serve tailors; they lie where the others do.
constexpr std::size_t kMain = 13;

/// The share of made-up vertices around a point.
double made_up_share(const io::ImportedMesh& mesh, const Vec3& point, double around_m) {
  const std::vector<Vec3>& positions = mesh.skin.positions;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : positions) nearest = std::min(nearest, (p - point).norm());
  std::size_t all = 0, made_up = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if ((positions[v] - point).norm() > nearest + around_m) continue;
    ++all;
    made_up += mesh.made_up[v];
  }
  return all > 0 ? static_cast<double>(made_up) / static_cast<double>(all) : 0.0;
}

}  // namespace

void warn_of_made_up(const io::ImportedMesh& mesh, const anatomy::Anatomy& anatomy,
                     std::vector<engine::Warning>& warnings) {
  if (mesh.made_up.empty()) return;
  std::string names;
  for (std::size_t i = 0; i < std::min(kMain, anatomy.landmarks.size()); ++i) {
    const body::Landmark& mark = anatomy.landmarks[i];
    if (mark.confidence <= 0.0) continue;
    if (made_up_share(mesh, mark.position, kAround * anatomy.stature_m) < kMostly) continue;
    names += (names.empty() ? "" : ", ") + std::string(body::name(mark.id));
  }
  if (names.empty()) return;
  warnings.push_back(
      {"landmarks-made-up", "",
       "Most of the skin around these landmarks is not in the file, and closes holes: " + names + ".",
       "Scan from more sides, also from below."});
}

}  // namespace bodice::tryon
