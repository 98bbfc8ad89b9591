#include "sheet.hpp"

#include <algorithm>

namespace bench {
namespace {

using bodice::geometry::Index;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

/// Columns of bodies are moved to the right and back alike, so that no body hides another from the front or
/// from the side.
constexpr int kColumns = 7;
constexpr double kColumn_m = 1.8, kRow_m = 2.1;

void append(const std::vector<Vec3>& positions, const std::vector<bodice::geometry::Triangle>& triangles,
            const Vec3& offset, TriMesh& to) {
  const auto first = static_cast<Index>(to.positions.size());
  for (const Vec3& p : positions) to.positions.push_back(p + offset);
  for (const auto& t : triangles) to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

}  // namespace

void Sheet::add(const std::vector<Vec3>& skin, const std::vector<bodice::geometry::Triangle>& triangles,
                const bodice::tryon::WornGarment& garment, const std::vector<Vec3>& positions) {
  const int column = count_ % kColumns, row = count_ / kColumns;
  ++count_;
  const Vec3 middle = bodice::geometry::bounding_box(skin).center();
  const Vec3 offset(kColumn_m * column - middle.x(), -kRow_m * row, kColumn_m * column - middle.z());
  append(skin, triangles, offset, bodies_);
  append(positions, garment.mesh.triangles, offset, garments_.mesh);
}

bool Sheet::write(const std::filesystem::path& png) const {
  bodice::io::Scene scene;
  scene.body = &bodies_;
  scene.garments.push_back(garments_);
  scene.garments[0].name = "cloth";
  scene.garments[0].frames = {garments_.mesh.positions};
  scene.garments[0].time_s = {0.0};
  const int columns = std::min(count_, kColumns), rows = (count_ + kColumns - 1) / kColumns;
  const std::size_t first = 0;
  return bodice::io::write_picture(scene, {&first, 1}, png,
                                   {.width = 300 * columns, .height = 350 * std::max(rows, 1)})
      .ok();
}

}  // namespace bench
