#include "sheet.hpp"

#include <bodice/io/scene.hpp>

namespace bench {
namespace {

/// Bodies stand on a diagonal, so that none hides another from the front or from the side.
constexpr int kColumns = 8;
constexpr double kColumn = 1.3, kRow = 2.1;  // of the stature

}  // namespace

void Sheet::add(const Case& c, const bodice::anatomy::Anatomy& anatomy) {
  using bodice::geometry::Vec3;
  const int column = count_ % kColumns, row = count_ / kColumns;
  ++count_;
  const Vec3 origin(kColumn * column, -kRow * row, kColumn * column);
  const Vec3 middle = bodice::geometry::bounding_box(c.mesh.positions).center();
  const auto first = static_cast<bodice::geometry::Index>(mesh_.positions.size());
  for (const Vec3& p : c.mesh.positions) mesh_.positions.push_back(origin + (p - middle) / anatomy.stature_m);
  for (const auto& t : c.mesh.triangles)
    mesh_.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  part_.insert(part_.end(), anatomy.part.begin(), anatomy.part.end());
}

bool Sheet::write(const std::filesystem::path& png) const {
  bodice::io::Scene scene;
  scene.body = &mesh_;
  scene.part = part_;
  const int rows = (count_ + kColumns - 1) / kColumns;
  return bodice::io::write_picture(scene, {}, png, {180 * kColumns, 290 * std::max(rows, 1), false, false})
      .ok();
}

}  // namespace bench
