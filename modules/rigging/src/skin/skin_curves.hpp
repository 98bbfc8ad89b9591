// Closed curves around the trunk and the limbs of a skin: where parts meet, and where a distance has one
// value.
#pragma once

#include <bitset>
#include <optional>
#include <vector>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/geodesic/distance_solver.hpp>
#include <bodice/geodesic/isoline.hpp>

namespace bodice::inline v0_1::rigging {

using geometry::Mat3;
using geometry::Vec3;

using PartSet = std::bitset<body::kPartCount>;

PartSet parts(std::initializer_list<body::Part> list);

/// A curve's middle and length.
struct Ring {
  Vec3 center = Vec3::Zero();
  double girth_m = 0.0;
};

/// Keeps references to skin and anatomy, which must outlive it.
class SkinCurves {
 public:
  SkinCurves(const engine::Context& context, const geometry::TriMesh& skin, const anatomy::Anatomy& anatomy);

  const geometry::TriMesh& skin() const { return skin_; }
  const anatomy::Anatomy& anatomy() const { return anatomy_; }
  const geometry::MeshEdges& edges() const { return edges_; }

  const body::Landmark& landmark(body::LandmarkId id) const {
    return anatomy_.landmarks[static_cast<std::size_t>(id)];
  }
  bool is_in(geometry::Index vertex, const PartSet& set) const {
    return set[static_cast<std::size_t>(anatomy_.part[vertex])];
  }

  /// Where `inside` meets all other parts: the longest closed curve. Nothing where they do not meet.
  std::optional<Ring> border(const PartSet& inside) const;

  /// Distance along the skin from a vertex, #V.
  geodesic::Field distances_from(geometry::Index vertex) const { return solver_.distances_from(vertex); }

  /// Where the field has the value: the longest closed curve of which most edges lie in `within`.
  std::optional<Ring> ring(const geodesic::Field& field, double level, const PartSet& within) const;

 private:
  const geometry::TriMesh& skin_;
  const anatomy::Anatomy& anatomy_;
  geometry::MeshEdges edges_;
  geodesic::DistanceSolver solver_;
};

}  // namespace bodice::rigging
