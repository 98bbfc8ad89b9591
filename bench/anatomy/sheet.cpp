#include "sheet.hpp"

#include <bodice/io/scene.hpp>

namespace bench {
namespace {

using bodice::geometry::Index;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

/// Half the thickness and half the length of a landmark's bar, of the stature, and the landmarks that have
/// one.
constexpr double kBar = 0.006, kBarLength = 0.16;
constexpr int kMarked = 13;
/// Bodies stand on a diagonal, so that none hides another from the front or from the side.
constexpr int kColumns = 8;
constexpr double kColumn = 1.3, kRow = 2.1;  // of the stature

}  // namespace

void Sheet::add(const TriMesh& skin, const bodice::anatomy::Anatomy& anatomy) {
  const int column = count_ % kColumns, row = count_ / kColumns;
  ++count_;
  const Vec3 origin(kColumn * column, -kRow * row, kColumn * column);
  const Vec3 middle = bodice::geometry::bounding_box(skin.positions).center();
  const auto first = static_cast<Index>(mesh_.positions.size());
  for (const Vec3& p : skin.positions) mesh_.positions.push_back(origin + (p - middle) / anatomy.stature_m);
  for (const auto& t : skin.triangles) mesh_.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  part_.insert(part_.end(), anatomy.part.begin(), anatomy.part.end());
  for (const auto& mark : anatomy.landmarks) {
    if (static_cast<int>(mark.id) >= kMarked || mark.confidence <= 0.0) continue;
    const Vec3 at = origin + (mark.position - middle) / anatomy.stature_m;
    const auto color = anatomy.part[mark.vertex] == bodice::body::Part::kHead ? bodice::body::Part::kThighL
                                                                              : bodice::body::Part::kHead;
    for (const int axis : {0, 2}) {
      Vec3 half = Vec3::Constant(kBar);
      half[axis] = kBarLength;
      add_bar(at - half, at + half, color);
    }
  }
}

void Sheet::add_bar(const Vec3& low, const Vec3& high, bodice::body::Part color) {
  const auto first = static_cast<Index>(mesh_.positions.size());
  for (int corner = 0; corner < 8; ++corner)
    mesh_.positions.push_back(
        {corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(), corner & 4 ? high.z() : low.z()});
  part_.resize(mesh_.positions.size(), color);
  constexpr int kQuads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : kQuads) {
    const auto at = [&](int k) { return first + static_cast<Index>(q[k]); };
    mesh_.triangles.push_back({at(0), at(1), at(2)});
    mesh_.triangles.push_back({at(0), at(2), at(3)});
  }
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
