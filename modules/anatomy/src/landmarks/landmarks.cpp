#include "landmarks/landmarks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <bodice/engine/parallel.hpp>

#include "landmarks/armpit.hpp"
#include "landmarks/armpit_position.hpp"
#include "landmarks/crown.hpp"
#include "landmarks/joints.hpp"
#include "landmarks/neck_position.hpp"
#include "landmarks/perineum_by_legs.hpp"
#include "landmarks/perineum_position.hpp"
#include "skin/curve.hpp"
#include "skin/soft_position.hpp"

namespace bodice::anatomy {
namespace {

using geodesic::Field;
using geodesic::Isoline;
using geometry::Index;
using geometry::kNoIndex;

/// No joint's loop lies further from the end of its limb, in the coordinate of that end: beyond, the border's
/// zero line means nothing.
constexpr float kNeckReach = 0.40F, kElbowReach = 0.36F, kKneeReach = 0.40F;
/// How far the knee's loop lies beyond the border, as a score.
constexpr float kKneeBeyond = 0.0115F;
/// How much nearer to the head than its tip the front of a foot reaches, and
/// how far to the sides; of head to feet.
constexpr float kBlunt = 0.010F, kToes = 0.04F;
/// A signature this many deviations off is no evidence any more. Of perineums one in fifty is more than 4
/// off; of armpits one in fifty is more than 5.3 off, and mostly right all the same.
constexpr double kHopelessArmpit = 10.0, kHopelessPerineum = 6.4;
/// A perineum whose lead over what lies in front of it is this far from the one that tells it from the fold
/// behind it, in deviations, is clearly one of the two.
constexpr double kClearlyNoFold = 1.0;
/// A perineum that its legs would move so far, of the size, lies somewhere else: of 3,356 bodies 8 wanted
/// more than .04, and the worst of all that were still 4 % of the stature off .066.
constexpr double kHopelessShift = 0.06;
/// An armpit leads its rivals by 2 deviations on nineteen bodies of twenty; all that were found over 6 % of
/// the stature off led by less than 0.8.
constexpr double kClearLead = 1.8;

double confidence_of(double misfit, double hopeless) {
  const double m = misfit / hopeless;
  return std::max(0.0, 1.0 - m * m);
}

float least_on(const Skin& skin, const Isoline& loop, const Field& field) {
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < loop.points.size(); ++i)
    least = std::min(least, value_at(skin, loop, i, field));
  return least;
}

float mean_on(const Skin& skin, const Isoline& loop, const Field& field) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < loop.points.size(); ++i) sum += value_at(skin, loop, i, field);
  return sum / static_cast<float>(loop.points.size());
}

const Field& from_end(const BodyExtremities& ends, Coordinate end, int side) {
  if (end == kFromHead) return *ends.from_head;
  return end == kOwnHand ? *ends.from_hand[side] : *ends.from_foot[side];
}

/// The border's loop: the longest closed zero line near the limb's end.
Girth border_loop(const Skin& skin, const BodyCoordinates& coordinates, const Border& border, float beyond,
                  int side, Coordinate end, float reach) {
  constexpr float kOutside = -1e-6F;
  const Field& from = from_end(coordinates.extremities(), end, side);
  const float no_neighbor = reach * coordinates.unit_of(end) + 2.0F * skin.graph.longest;
  Field score(skin.mesh.positions.size(), kOutside);
  for (std::size_t v = 0; v < score.size(); ++v) {
    if (!(from[v] < no_neighbor)) continue;
    const CoordinateArray x = coordinates.at(v, side);
    const float s = border(x) + beyond;
    score[v] = x[end] < reach ? s : std::min(s, kOutside);
  }
  const float zero = 0.0F;
  const auto lines = geodesic::isolines(skin.mesh, skin.edges, score, {&zero, 1})[0];
  const Isoline* best = nullptr;
  for (const Isoline& line : lines)
    if (best == nullptr || line.girth_m > best->girth_m) best = &line;
  if (best == nullptr) return {};
  Girth girth{best->centroid, skin.edges.ends[best->edges[0]][0], best->girth_m, best->closed ? 1.0 : 0.5};
  girth.level_m = mean_on(skin, *best, from);
  girth.from_front = least_on(skin, *best, coordinates.from_front());
  girth.from_back = least_on(skin, *best, coordinates.from_back());
  return girth;
}

body::Landmark at_vertex(const Skin& skin, Index v, double confidence) {
  if (v == kNoIndex) return {};
  return {body::LandmarkId::kCrown, skin.mesh.positions[v], v, confidence};
}

body::Landmark at_place(const geometry::Vec3& place, Index v, double confidence) {
  if (v == kNoIndex) return {};
  return {body::LandmarkId::kCrown, place, v, confidence};
}

/// The front of a foot is blunt: what is nearly as far from the head as its farthest vertex has a share.
geometry::Vec3 toe_place(const Skin& skin, const BodyExtremities& ends, int side) {
  const float blunt = kBlunt * ends.head_to_feet;
  const geodesic::Field &own = *ends.from_foot[side], &other = *ends.from_foot[1 - side];
  const float tip = (*ends.from_head)[ends.foot[side]];
  return soft_position(skin, ends.foot[side], static_cast<double>(kToes * ends.head_to_feet), [&](Index v) {
    return own[v] < other[v] ? std::max(0.0F, blunt - std::abs(tip - (*ends.from_head)[v])) : 0.0F;
  });
}

body::Landmark at_joint(const geometry::Vec3& place, const Girth& girth) {
  return {body::LandmarkId::kCrown, place, girth.vertex, girth.confidence};
}

}  // namespace

Landmarks find_landmarks(const engine::Context& context, const Skin& skin,
                         const BodyCoordinates& coordinates) {
  Landmarks marks;
  marks.perineum = coordinates.perineum();
  marks.perineum_place = coordinates.perineum_position();
  const double no_fold = std::abs(static_cast<double>(coordinates.perineum_margin() - kFoldMargin));
  marks.perineum_confidence =
      confidence_of(static_cast<double>(coordinates.perineum_mahalanobis()), kHopelessPerineum) *
      std::min(1.0, no_fold / kClearlyNoFold);
  constexpr std::size_t kTasks = 7;  // the neck, and elbow, knee and armpit of both sides
  engine::parallel_for(context, kTasks, 1, [&](std::size_t task, std::size_t) {
    const int side = static_cast<int>(task % 2);
    if (task == 6) marks.neck = border_loop(skin, coordinates, kNeck, 0.0F, 0, kFromHead, kNeckReach);
    if (task < 2)
      marks.elbow[side] = border_loop(skin, coordinates, kElbow, 0.0F, side, kOwnHand, kElbowReach);
    if (task == 2 || task == 3)
      marks.knee[side] = border_loop(skin, coordinates, kKnee, kKneeBeyond, side, kOwnFoot, kKneeReach);
    if (task != 4 && task != 5) return;
    const SignedPlace armpit = find_armpit(context, skin, coordinates, side);
    marks.armpit[side] = armpit.vertex;
    marks.armpit_place[side] = armpit.position;
    marks.armpit_confidence[side] = confidence_of(static_cast<double>(armpit.misfit), kHopelessArmpit) *
                                    std::min(1.0, static_cast<double>(armpit.lead) / kClearLead);
  });
  const Ball head = head_ball(skin, coordinates);
  const Crown crown = find_crown(skin, coordinates, marks.neck, head);
  marks.crown = crown.vertex;
  marks.crown_place = crown.place;
  marks.neck_place = neck_joint(skin, coordinates, marks, head);
  const auto& positions = skin.mesh.positions;
  const BodyExtremities& ends = coordinates.extremities();
  for (int side = 0; side < 2; ++side) {
    marks.elbow_place[side] =
        elbow_joint(coordinates, marks.elbow[side], marks.armpit_place[side], positions[ends.hand[side]]);
    marks.knee_place[side] =
        knee_joint(coordinates, marks.knee[side], marks.perineum_place, positions[ends.foot[side]]);
  }
  marks.neck_place = neck_by_measures(skin, coordinates, marks);
  marks.perineum_place = perineum_by_shape(skin, coordinates, marks);
  marks.armpit_place = armpits_by_arms(skin, coordinates, marks);
  const MovedPerineum perineum = perineum_by_legs(skin, coordinates, marks);
  marks.perineum_place = perineum.place;
  marks.perineum_confidence *= confidence_of(perineum.wanted, kHopelessShift);
  return marks;
}

std::vector<body::Landmark> as_list(const Skin& skin, const BodyExtremities& ends, const Landmarks& marks) {
  std::vector<body::Landmark> list{
      at_place(marks.crown_place, marks.crown, marks.crown_confidence),
      at_place(marks.neck_place, marks.neck.vertex, marks.neck.confidence),
      at_vertex(skin, ends.hand[0], marks.fingertip_confidence[0]),
      at_vertex(skin, ends.hand[1], marks.fingertip_confidence[1]),
      at_joint(marks.elbow_place[0], marks.elbow[0]),
      at_joint(marks.elbow_place[1], marks.elbow[1]),
      at_place(marks.armpit_place[0], vertex_near(skin, marks.armpit_place[0], marks.armpit[0]),
               marks.armpit_confidence[0]),
      at_place(marks.armpit_place[1], vertex_near(skin, marks.armpit_place[1], marks.armpit[1]),
               marks.armpit_confidence[1]),
      at_place(marks.perineum_place, vertex_near(skin, marks.perineum_place, marks.perineum),
               marks.perineum_confidence),
      at_joint(marks.knee_place[0], marks.knee[0]),
      at_joint(marks.knee_place[1], marks.knee[1]),
      at_place(toe_place(skin, ends, 0), ends.foot[0], marks.toe_confidence[0]),
      at_place(toe_place(skin, ends, 1), ends.foot[1], marks.toe_confidence[1])};
  for (int i = 0; i < body::kLandmarkCount; ++i) list[i].id = static_cast<body::LandmarkId>(i);
  return list;
}

}  // namespace bodice::anatomy
