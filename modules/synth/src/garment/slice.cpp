// Slices of the skin across the trunk's axes.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "garment/outline.hpp"

namespace bodice::inline v0_1::synth {
namespace {

// These are shares of the distance from perineum to neck.
constexpr double kPelvis = 0.25;        // height of the pelvis
constexpr double kGreatestLean = 0.25;  // with more, the slice is not the pelvis

Vec3 crossing(const Vec3& a, const Vec3& b, int axis, double plane) {
  return a + (plane - a[axis]) / (b[axis] - a[axis]) * (b - a);
}

using MeshEdge = std::pair<geometry::Index, geometry::Index>;

/// The segment that one triangle adds to a slice.
struct Piece {
  std::array<MeshEdge, 2> edge;  ///< edges across which the curve continues
  std::array<Vec3, 2> end;
  double share = 0.0;  ///< share of the triangle's corners in wanted parts
};

/// Segments joined across shared mesh edges into curves.
struct Curves {
  std::vector<Piece> pieces;

  std::vector<Vec3> points_of_wanted(double least_share) const;

 private:
  std::vector<std::size_t> curve_of_pieces() const;
};

std::vector<std::size_t> Curves::curve_of_pieces() const {
  std::vector<std::size_t> root(pieces.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::vector<std::pair<MeshEdge, std::size_t>> joints;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const MeshEdge& edge : pieces[i].edge) joints.emplace_back(edge, i);
  std::sort(joints.begin(), joints.end());
  for (std::size_t j = 1; j < joints.size(); ++j)
    if (joints[j].first == joints[j - 1].first) root[find(joints[j].second)] = find(joints[j - 1].second);
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = find(i);
  return root;
}

std::vector<Vec3> Curves::points_of_wanted(double least_share) const {
  const std::vector<std::size_t> curve = curve_of_pieces();
  std::vector<double> length(pieces.size(), 0.0), wanted(pieces.size(), 0.0);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double piece = (pieces[i].end[1] - pieces[i].end[0]).norm();
    length[curve[i]] += piece;
    wanted[curve[i]] += piece * pieces[i].share;
  }
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (wanted[curve[i]] > 0.0 && wanted[curve[i]] >= least_share * length[curve[i]])
      points.insert(points.end(), pieces[i].end.begin(), pieces[i].end.end());
  return points;
}

}  // namespace

LocalSkin::LocalSkin(const SegmentedBody& body, const TrunkFrame& frame) : body_(body) {
  local_.reserve(body.mesh.positions.size());
  for (const Vec3& p : body.mesh.positions) local_.push_back(frame.to_local(p));
  height_.reserve(body.mesh.triangles.size());
  for (const geometry::Triangle& t : body.mesh.triangles) {
    const auto [low, high] = std::minmax({local_[t[0]].y(), local_[t[1]].y(), local_[t[2]].y()});
    height_.push_back({low, high});
  }
}

std::vector<Vec3> LocalSkin::slice(double y, const PartFilter& wanted, double least_share) const {
  Curves curves;
  for (std::size_t i = 0; i < height_.size(); ++i) {
    if (height_[i][0] >= y || height_[i][1] < y) continue;
    const geometry::Triangle& t = body_.mesh.triangles[i];
    Piece piece;
    int ends = 0;
    for (int k = 0; k < 3; ++k) {
      const geometry::Index v = t[k], w = t[(k + 1) % 3];
      if (wanted(body_.part[v])) piece.share += 1.0 / 3.0;
      if ((local_[v].y() < y) == (local_[w].y() < y)) continue;
      piece.edge[ends] = std::minmax(v, w);
      piece.end[ends++] = crossing(local_[std::min(v, w)], local_[std::max(v, w)], 1, y);
    }
    curves.pieces.push_back(piece);
  }
  return curves.points_of_wanted(least_share);
}

std::vector<Vec3> LocalSkin::slab(int axis, double low, double high, const PartFilter& wanted) const {
  std::vector<Vec3> points;
  const auto cut = [&](const Vec3& a, const Vec3& b, double plane) {
    if ((a[axis] < plane) == (b[axis] < plane)) return;
    points.push_back(crossing(a, b, axis, plane));
  };
  for (const geometry::Triangle& t : body_.mesh.triangles) {
    if (!wanted(body_.part[t[0]]) || !wanted(body_.part[t[1]]) || !wanted(body_.part[t[2]])) continue;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = local_[t[k]], &b = local_[t[(k + 1) % 3]];
      if (a[axis] >= low && a[axis] <= high) points.push_back(a);
      cut(a, b, low);
      cut(a, b, high);
    }
  }
  return points;
}

TrunkFrame upright(const SegmentedBody& body, const TrunkFrame& frame) {
  const Vec3 neck = local_landmark(body, frame, body::LandmarkId::kNeck);
  geometry::Box box;
  for (const Vec3& p : LocalSkin(body, frame).slice(kPelvis * neck.y(), body::is_torso)) box.extend(p);
  if (box.empty() ||
      std::max(std::abs(box.center().x()), std::abs(box.center().z())) > kGreatestLean * neck.y())
    return frame;
  TrunkFrame turned = frame;
  const Vec3 up = frame.axes * (neck - box.center()), left = frame.axes.col(0);
  turned.axes.col(1) = up.normalized();
  turned.axes.col(2) = left.cross(up).normalized();
  turned.axes.col(0) = turned.axes.col(1).cross(turned.axes.col(2));
  const Vec3 top = frame.to_world(neck);
  turned.origin = top + turned.axes.col(1).dot(frame.origin - top) * turned.axes.col(1);
  return turned;
}

}  // namespace bodice::synth
