// The top of the head.
#include <algorithm>
#include <cmath>

#include <coefficients/crown.hpp>

#include "coordinates/body_lengths.hpp"
#include "landmarks/base/correction.hpp"
#include "landmarks/base/far_end.hpp"
#include "landmarks/base/landmark_kind.hpp"
#include "skin/soft_position.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_crown {
namespace {

using geodesic::Field;
using geometry::Index;
using geometry::kNoIndex;
using geometry::Vec3;
namespace data = coefficients::crown;

/// The share at which the crown divides the path over the head from the back of the neck to its front. It is
/// the same on children and adults, whatever the size of the head.
constexpr float kFromNape = 0.485F;
/// Cost of a squared deviation from that share, against distance from the feet as a fraction of the body
/// size. Without it the forehead wins on bodies that lean back.
constexpr float kShareWeight = 2.0F;
/// The range of that score that the dome of the head spans, and the dome's radius; fractions of the body
/// size.
constexpr float kDome = 0.02F, kDomeRadius = 0.07F;
/// The cross-check looks for the crown this near to the first estimate, as a fraction of the body size.
constexpr float kNearCrown = 0.20F;
/// One crown in a hundred that is right lies farther from its second estimate, as a fraction of the body
/// size.
constexpr double kMaxDifference = 0.06;

/// Skin that lies deeper below the middle of the head, by its radius, is the neck's.
constexpr double kChin = 0.5;
/// The farthest point of a head lies 1.3 to 1.7 times as far from its middle as its side does. Two bare heads
/// in a hundred reach farther than .016 of the body size, and closed scans that have lost their ears up to
/// .018. Buns reach .02 and more, or leave a hollow.
constexpr double kLongHead = 1.6, kMaxOverhang = 0.02;

/// How far a vertex lies from the feet, less what its share of the path over the head costs.
class CrownScore {
 public:
  CrownScore(const LandmarkInput& input, const Loop& neck) : input_(input), neck_(neck) {}

  float operator()(Index v) const {
    const Field &left = *input_.tips().from_foot[0], &right = *input_.tips().from_foot[1];
    const float size = input_.coordinates.size_m();
    const float nape = input_.coordinates.from_back()[v] - neck_.from_back;
    const float throat = input_.coordinates.from_front()[v] - neck_.from_front;
    const float off = nape / std::max(nape + throat, 1e-6F * size) - kFromNape;
    return 0.5F * (left[v] + right[v]) / size - kShareWeight * off * off;
  }

 private:
  const LandmarkInput& input_;
  const Loop& neck_;
};

/// The vertex of the head's outer skin with the best score; the tip of the head if none has one.
Index best_vertex(const LandmarkInput& input, const CrownScore& score) {
  const auto& positions = input.skin.mesh.positions;
  Index best = input.tips().head;
  float most = -1.0F;
  for (Index v = 0; v < positions.size(); ++v) {
    if ((positions[v] - input.head.center).norm() < kOuterHead * input.head.radius) continue;
    if (input.skin.component[v] != 0 || !input.coordinates.on_head(v)) continue;
    const float s = score(v);
    if (!(s > most)) continue;
    most = s;
    best = v;
  }
  return best;
}

/// A head that is bent back folds the nape, so that the path over it looks like that of a shorter head:
/// distances through space show how far it is bent.
Correction head_correction(const LandmarkInput& input, const Loop& neck, const Vec3& first) {
  const Midline& middle = input.coordinates.midline();
  const Vec3 &front = middle.front.position, &back = middle.back.position;
  const double size = input.size_m();
  const BodyLengths lengths = body_lengths(input.coordinates);
  std::vector<double> measures(lengths.begin(), lengths.end());
  measures.push_back((input.head.center - front).norm() / size);
  measures.push_back((input.head.center - back).norm() / size);
  measures.push_back(input.head.radius / size);
  const Vec3 up = (input.head.center - neck.center).normalized(), through = front - back;
  const Vec3 forward = (through - through.dot(up) * up).normalized();
  return {LandmarkId::kCrown,
          first,
          {{up, measures, {"up", data::kUp}}, {forward, measures, {"forward", data::kForward}}},
          kMostByLengths};
}

FoundLandmark find_crown(const LandmarkInput& input, int) {
  const Index tip = input.tips().head;
  return {{LandmarkId::kCrown, input.skin.mesh.positions[tip], tip, 1.0}, {}};
}

/// The path from the front of the neck to the crown, in radii of the head: 3.0 on 80 made heads and 3.4 on 38
/// real ones, with standard deviations of 6 %.
constexpr double kFromThroat = 3.2;

/// The point of the bare outline, before hair that stands off, with the likeliest path from the front of
/// the neck. It is the point beside the hair where the crown is under it.
Vec3 crown_before_hair(const LandmarkInput& input, const Loop& neck, const HeadProfile& profile) {
  const double wanted_m = kFromThroat * input.head.radius;
  const auto off_m = [&](const Vec3& position) {
    const Index v = vertex_near(input.skin, position, input.tips().head);
    return std::abs(double{input.coordinates.from_front()[v]} - double{neck.from_front} - wanted_m);
  };
  return std::ranges::min(profile.before_hair(), {}, off_m);
}

/// The vertex that is far from both feet and as far from the back of the neck as from its front, then
/// corrected, unless that lies on hair; the tip of the head stays where no neck was found.
FoundLandmark refine_crown(const LandmarkInput& input, const Landmarks& marks, int) {
  const Loop& neck = marks[LandmarkId::kNeck].loop;
  FoundLandmark crown = marks[LandmarkId::kCrown];
  if (!marks.head_profile) return crown;
  const CrownScore score(input, neck);
  const Index best = best_vertex(input, score);
  const float most = score(best);
  // A hand over the head is nearer than the dome is wide, and farther from the feet.
  const auto dome = [&](Index v) {
    return input.coordinates.on_head(v) ? std::max(0.0F, kDome - (most - score(v))) : 0.0F;
  };
  const double radius = static_cast<double>(kDomeRadius * input.coordinates.size_m());
  const Vec3 first = soft_position(input.skin, best, radius, dome);
  crown.mark.position = marks.head_profile->is_on_hair(first)
                            ? crown_before_hair(input, neck, *marks.head_profile)
                            : corrected(input, head_correction(input, neck, first)).position;
  crown.mark.vertex = vertex_near(input.skin, crown.mark.position, best);
  return crown;
}

double difference(const LandmarkInput& input, const Landmarks& marks, int) {
  return difference_from_far_end(input, *input.tips().from_head, marks.at(LandmarkId::kCrown), kNearCrown);
}

/// How far the head reaches beyond what its breadth lets expect: hair that stands off lies there.
double overhang(const LandmarkInput& input, const HeadProfile& profile) {
  double farthest = 0.0, breadth = 0.0;
  const auto& positions = input.skin.mesh.positions;
  for (Index v = 0; v < positions.size(); ++v) {
    const Vec3 offset = positions[v] - input.head.center;
    if (input.skin.component[v] != 0 || !input.coordinates.on_head(v)) continue;
    if (offset.dot(profile.up()) < -kChin * input.head.radius) continue;
    farthest = std::max(farthest, offset.norm());
    breadth = std::max(breadth, std::abs(offset.dot(profile.across())));
  }
  return std::max(0.0, farthest - kLongHead * breadth) / input.size_m();
}

/// Hair that stands off, by the sign that shows it best; 1 is the most that a bare head has.
double hair(const LandmarkInput& input, const Landmarks& marks, int) {
  if (!marks.head_profile) return -1.0;
  const HeadProfile& profile = *marks.head_profile;
  return std::max(overhang(input, profile) / kMaxOverhang, profile.hollow() / kMaxHollow);
}

}  // namespace
}  // namespace of_crown

LandmarkKind crown() {
  return {
      .id = LandmarkId::kCrown,
      .part = body::Part::kHead,
      .find = of_crown::find_crown,
      .refine = of_crown::refine_crown,
      .checks = {{{of_crown::difference, of_crown::kMaxDifference,
                   "The top of the head and the point of the head that is farthest from the perineum lie "
                   "apart."},
                  {of_crown::hair, 1.0,
                   "Something stands off the head, such as hair: the crown and the stature may be wrong."}}},
      .recipe = Recipe::kCorrections};
}

}  // namespace bodice::anatomy
