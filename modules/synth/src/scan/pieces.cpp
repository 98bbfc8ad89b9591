#include "scan/pieces.hpp"

#include <algorithm>
#include <array>

#include "scan/flaws.hpp"
#include "scan/landmark_of.hpp"

namespace bodice::inline v0_1::synth {
namespace {

using body::Part;
using geometry::TriMesh;
using geometry::Vec3;

/// Sleeves and trouser legs stand off this far; pieces with gaps shrink, and tucked ones grow, by the other.
constexpr double kCloth_m = 0.012, kGap_m = 0.004;

enum BodyPiece { kHead, kTrunk, kArmL, kArmR, kHandL, kHandR, kLegL, kLegR, kShoeL, kShoeR, kPieceCount };
constexpr std::array<const char*, kPieceCount> kNames = {"head",   "trunk", "arm_l", "arm_r",  "hand_l",
                                                         "hand_r", "leg_l", "leg_r", "foot_l", "foot_r"};
constexpr std::array<const char*, kPieceCount> kClothNames = {"head",   "shirt",  "sleeve_l",   "sleeve_r",
                                                              "hand_l", "hand_r", "trousers_l", "trousers_r",
                                                              "shoe_l", "shoe_r"};

int piece_at(const Body& body, Part part, const Vec3& p) {
  using body::LandmarkId;
  const auto beyond = [&](LandmarkId from, LandmarkId to) {  // beyond `to`, seen from `from`
    const Vec3 end = landmark_of(body, to);
    return (p - end).dot(end - landmark_of(body, from)) > 0.0;
  };
  const int side = part != Part::kHead && static_cast<int>(part) % 2 == 0;
  switch (part) {
    case Part::kHead:
      return kHead;
    case Part::kUpperArmL:
    case Part::kUpperArmR:
      return kArmL + side;
    case Part::kForearmL:
    case Part::kForearmR:
      return (beyond(of_side(LandmarkId::kElbowL, side), of_side(LandmarkId::kWristL, side)) ? kHandL
                                                                                             : kArmL) +
             side;
    case Part::kThighL:
    case Part::kThighR:
      return kLegL + side;
    case Part::kCalfL:
    case Part::kCalfR:
      return (beyond(of_side(LandmarkId::kKneeL, side), of_side(LandmarkId::kAnkleL, side)) ? kShoeL
                                                                                            : kLegL) +
             side;
    default:
      return kTrunk;
  }
}

/// Shrinks a piece around its middle by a distance.
void shrink(double by_m, TriMesh& piece) {
  const geometry::Box box = geometry::bounding_box(piece.positions);
  const Vec3 size = box.size();
  for (Vec3& p : piece.positions)
    for (int k = 0; k < 3; ++k) p[k] -= (p[k] - box.center()[k]) * std::min(0.5, 2.0 * by_m / size[k]);
}

}  // namespace

std::vector<ScanMesh> cut_to_pieces(ScanKind kind, const Body& body) {
  std::vector<int> piece(body.mesh.triangles.size());
  for (std::size_t t = 0; t < piece.size(); ++t) {
    const Vec3 middle = (body.mesh.corner(t, 0) + body.mesh.corner(t, 1) + body.mesh.corner(t, 2)) / 3.0;
    piece[t] = piece_at(body, body.part[body.mesh.triangles[t][0]], middle);
  }
  const bool clothes = kind == ScanKind::kClothes;
  std::vector<ScanMesh> meshes;
  for (int k = 0; k < kPieceCount; ++k) {
    TriMesh shape = take(body.mesh, piece, k);
    const bool skin = k == kHead || k == kHandL || k == kHandR;
    if (clothes && !skin) {
      const std::vector<Vec3> normal = vertex_normals(shape);
      for (std::size_t v = 0; v < normal.size(); ++v) shape.positions[v] += kCloth_m * normal[v];
    }
    if (!clothes) shrink(kind == ScanKind::kPieces ? kGap_m : -kGap_m, shape);
    meshes.push_back({clothes ? kClothNames[k] : kNames[k], std::move(shape)});
  }
  return meshes;
}

}  // namespace bodice::synth
