#include "landmarks.hpp"

#include <cmath>

namespace bodice::anatomy {
namespace {

using geodesic::Field;
using geodesic::Isoline;
using geometry::Index;
using geometry::kNoIndex;
using geometry::Vec3;

constexpr double kSizeToStature = 2.19;               ///< head to feet plus foot to foot along the skin
constexpr float kKnee = 0.615F;                       ///< of the way from toe to perineum
constexpr float kElbow = 0.525F;                      ///< of half the way from hand to hand
constexpr float kArmpit = 0.405F;                     ///< of the way from hand to hand
constexpr float kNeckLow = 0.13F, kNeckHigh = 0.26F;  ///< of the stature, from the crown
constexpr std::size_t kNeckLevels = 27;

const Isoline* widest(const std::vector<Isoline>& lines) {
  const Isoline* best = nullptr;
  for (const Isoline& line : lines)
    if (best == nullptr || line.girth_m > best->girth_m) best = &line;
  return best;
}

Girth girth_at(const Skin& skin, const Field& field, float level) {
  const auto lines = geodesic::isolines(skin.mesh, skin.edges, field, {&level, 1});
  const Isoline* loop = widest(lines[0]);
  if (loop == nullptr) return {level, Vec3::Zero(), 0.0, 0.0};
  return {level, loop->centroid, loop->girth_m, loop->closed ? 1.0 : 0.5};
}

Girth find_neck(const Skin& skin, const Field& from_head, double stature) {
  std::array<float, kNeckLevels> levels{};
  for (std::size_t i = 0; i < kNeckLevels; ++i)
    levels[i] = static_cast<float>(stature) * (kNeckLow + (kNeckHigh - kNeckLow) * static_cast<float>(i) /
                                                              static_cast<float>(kNeckLevels - 1));
  Girth best;
  const auto curves = geodesic::isolines(skin.mesh, skin.edges, from_head, levels);
  for (std::size_t i = 0; i < kNeckLevels; ++i) {
    const Isoline* loop = widest(curves[i]);
    if (loop == nullptr || (best.girth_m > 0.0 && loop->girth_m >= best.girth_m)) continue;
    best = {levels[i], loop->centroid, loop->girth_m, loop->closed ? 1.0 : 0.5};
  }
  return best;
}

/// The way between the feet climbs one leg and comes down the other; its place nearest to the head is between
/// the legs, however the legs differ in pose.
Index find_perineum(const Skin& skin, const BodyEnds& ends) {
  Index best = kNoIndex;
  for (const Index v : geodesic::descend(skin.graph, *ends.from_foot[0], ends.foot[1]))
    if (best == kNoIndex || (*ends.from_head)[v] < (*ends.from_head)[best]) best = v;
  return best;
}

/// Where the way from the hand to the foot of its side leaves the arm.
Index find_armpit(const Skin& skin, const BodyEnds& ends, int side) {
  const Field& from_hand = *ends.from_hand[side];
  const float level = kArmpit * ends.hands_apart;
  Index best = kNoIndex;
  for (const Index v : geodesic::descend(skin.graph, from_hand, ends.foot[side]))
    if (best == kNoIndex || std::abs(from_hand[v] - level) < std::abs(from_hand[best] - level)) best = v;
  return best;
}

}  // namespace

BodyEnds in_body_order(const EndPoints& ends, const Sides& sides) {
  BodyEnds body;
  body.head = ends.vertex[kHead];
  body.from_head = &ends.field[kHead];
  const std::array<End, 2> hand = sides.a_is_left ? std::array{kHandA, kHandB} : std::array{kHandB, kHandA};
  const std::array<End, 2> foot = sides.a_is_left ? std::array{kFootA, kFootB} : std::array{kFootB, kFootA};
  for (int side = 0; side < 2; ++side) {
    body.hand[side] = ends.vertex[hand[side]];
    body.foot[side] = ends.vertex[foot[side]];
    body.from_hand[side] = &ends.field[hand[side]];
    body.from_foot[side] = &ends.field[foot[side]];
  }
  body.hands_apart = ends.hands_apart();
  body.feet_apart = ends.feet_apart();
  body.head_to_feet = ends.head_to_feet();
  return body;
}

Landmarks find_landmarks(const Skin& skin, const BodyEnds& ends) {
  Landmarks marks;
  marks.stature_m = static_cast<double>(ends.head_to_feet + ends.feet_apart) / kSizeToStature;
  marks.neck = find_neck(skin, *ends.from_head, marks.stature_m);
  marks.perineum = find_perineum(skin, ends);
  for (int side = 0; side < 2; ++side) {
    marks.armpit[side] = find_armpit(skin, ends, side);
    marks.elbow[side] = girth_at(skin, *ends.from_hand[side], 0.5F * kElbow * ends.hands_apart);
    marks.knee[side] = girth_at(skin, *ends.from_foot[side], 0.5F * kKnee * ends.feet_apart);
  }
  return marks;
}

namespace {

body::Landmark at_vertex(const Skin& skin, Index v) {
  if (v == kNoIndex) return {};
  return {body::LandmarkId::kCrown, skin.mesh.positions[v], v, 1.0};
}

body::Landmark at_girth(const Skin& skin, const Girth& girth) {
  Index nearest = kNoIndex;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < skin.mesh.positions.size(); ++v) {
    const double d = (skin.mesh.positions[v] - girth.center).squaredNorm();
    if (d < least) {
      least = d;
      nearest = static_cast<Index>(v);
    }
  }
  return {body::LandmarkId::kCrown, girth.center, nearest, girth.confidence};
}

}  // namespace

std::vector<body::Landmark> as_list(const Skin& skin, const BodyEnds& ends, const Landmarks& marks) {
  std::vector<body::Landmark> list{
      at_vertex(skin, ends.head),       at_girth(skin, marks.neck),       at_vertex(skin, ends.hand[0]),
      at_vertex(skin, ends.hand[1]),    at_girth(skin, marks.elbow[0]),   at_girth(skin, marks.elbow[1]),
      at_vertex(skin, marks.armpit[0]), at_vertex(skin, marks.armpit[1]), at_vertex(skin, marks.perineum),
      at_girth(skin, marks.knee[0]),    at_girth(skin, marks.knee[1]),    at_vertex(skin, ends.foot[0]),
      at_vertex(skin, ends.foot[1])};
  for (int i = 0; i < body::kLandmarkCount; ++i) list[i].id = static_cast<body::LandmarkId>(i);
  return list;
}

}  // namespace bodice::anatomy
