#include <bodice/anatomy/plausible.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <bodice/engine/message.hpp>

#include "check/flat_parts.hpp"
#include "check/thighs.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;
using body::Part;

struct Range {
  double low, high;
  bool holds(double value) const { return value >= low && value <= high; }
};

// Wider than whatever was seen on clean bodies from one year on, BMI 17 to 46, in any pose, and on stylized
// figures; boxes, chairs, fragments and two people in one skin lie outside of at least one.
/// Area of the skin over the square of the stature: .55 to .85.
constexpr Range kArea{0.36, 1.0};
/// A skin this large is that of a very heavy body, on which the landmarks agree, or of two bodies, on which
/// at least so many are in doubt.
constexpr double kLargeArea = 0.93;
constexpr int kDoubts = 4;
/// The number of landmarks in doubt from which a mesh with extremities at unusual distances, or with limbs
/// that meet, is no body.
constexpr int kTooManyDoubts = 6;
constexpr double kTypicalArea = 0.63;
// Shares of the skin's area: head .08 to .2, trunk .3 to .5, an arm .07 to .12, a leg .13 to .22.
constexpr Range kHeadShare{0.03, 0.42}, kTrunkShare{0.14, 0.65}, kArmShare{0.025, 0.2}, kLegShare{0.06, 0.3};
/// A body sits where the cosines of both thighs are below this; one in one skin with its chair has up to .62.
constexpr double kSitting = 0.65;
/// A limb to its counterpart.
constexpr double kLimbRatio = 2.2;
// Straight lengths over the stature, joint to joint: upper arm .15 to .2, forearm .2 to .27, thigh and calf
// .2 to .3. Where the armpit of a small child is found too low, its upper arm has .067.
constexpr Range kLimbLength{0.05, 0.42};

struct Shares {
  std::array<double, body::kPartCount> of{};
  double area = 0.0;

  double part(Part p) const { return of[static_cast<std::size_t>(p)]; }
  double pair(Part upper, Part lower) const { return part(upper) + part(lower); }
};

Shares shares_of(const geometry::TriMesh& skin, const Anatomy& anatomy) {
  Shares shares;
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    const double area = 0.5 * area_vector(skin, t).norm();
    shares.of[static_cast<std::size_t>(anatomy.part[skin.triangles[t][0]])] += area;
    shares.area += area;
  }
  for (double& share : shares.of) share /= shares.area;
  return shares;
}

/// The warnings that landmarks are uncertain or that their cross-checks disagree.
int count_doubts(const Anatomy& anatomy) {
  return static_cast<int>(
      std::count_if(anatomy.warnings.begin(), anatomy.warnings.end(), [](const engine::Warning& w) {
        return w.code.ends_with("-uncertain") || w.code.ends_with("-disagrees");
      }));
}

bool warned_of(const Anatomy& anatomy, std::string_view code) {
  return std::any_of(anatomy.warnings.begin(), anatomy.warnings.end(),
                     [&](const engine::Warning& w) { return w.code == code; });
}

/// Arms and legs that both stay welded, with landmarks in doubt, are those of two bodies in one skin. A hand
/// may rest on a thigh of one body, which leaves fewer in doubt.
bool stays_welded(const Anatomy& anatomy) {
  if (!warned_of(anatomy, "legs-fused")) return false;
  return (warned_of(anatomy, "limbs-fused") && count_doubts(anatomy) >= kDoubts) ||
         (warned_of(anatomy, "hand-fused-to-leg") && count_doubts(anatomy) >= kTooManyDoubts);
}

void check_limbs(const Shares& shares, std::vector<std::string>& found) {
  const std::array arms = {shares.pair(Part::kUpperArmL, Part::kForearmL),
                           shares.pair(Part::kUpperArmR, Part::kForearmR)};
  const std::array legs = {shares.pair(Part::kThighL, Part::kCalfL),
                           shares.pair(Part::kThighR, Part::kCalfR)};
  const auto check = [&](const std::array<double, 2>& limbs, const Range& range, const char* what) {
    const bool differ = limbs[0] > kLimbRatio * limbs[1] || limbs[1] > kLimbRatio * limbs[0];
    if (!range.holds(limbs[0]) || !range.holds(limbs[1]) || differ)
      found.push_back(engine::message("what would be the ", what, " has ", std::round(100.0 * limbs[0]),
                                      " and ", std::round(100.0 * limbs[1]), " % of the skin"));
  };
  check(arms, kArmShare, "arms");
  check(legs, kLegShare, "legs");
}

void check_lengths(const Anatomy& anatomy, std::vector<std::string>& found) {
  const auto at = [&](LandmarkId id) { return anatomy.landmarks[static_cast<std::size_t>(id)].position; };
  struct Bone {
    LandmarkId from, to;
    const char* name;
  };
  for (const Bone& bone : {Bone{LandmarkId::kElbowL, LandmarkId::kFingertipL, "forearms"},
                           Bone{LandmarkId::kArmpitL, LandmarkId::kElbowL, "upper arms"},
                           Bone{LandmarkId::kPerineum, LandmarkId::kKneeL, "thighs"},
                           Bone{LandmarkId::kKneeL, LandmarkId::kToeL, "calves"}})
    for (int side = 0; side < 2; ++side) {
      const bool middle = bone.from == LandmarkId::kPerineum;
      const double length =
          (at(middle ? bone.from : body::of_side(bone.from, side)) - at(body::of_side(bone.to, side)))
              .norm() /
          anatomy.stature_m;
      if (kLimbLength.holds(length)) continue;
      found.push_back(engine::message("one of the ", bone.name, " would be ", length, " of its height long"));
      break;
    }
}

}  // namespace

std::vector<std::string> contradictions(const geometry::TriMesh& skin, const Anatomy& anatomy) {
  std::vector<std::string> found;
  const Shares shares = shares_of(skin, anatomy);
  const double height2 = anatomy.stature_m * anatomy.stature_m;
  if (!(shares.area > 0.0) || !(height2 > 0.0)) return {"it has no size"};
  const double area = shares.area / height2;
  if (!kArea.holds(area) || (area > kLargeArea && count_doubts(anatomy) >= kDoubts))
    found.push_back(
        engine::message("its surface is ", area / kTypicalArea, " times that of a body of its height"));
  if (!kHeadShare.holds(shares.part(Part::kHead)))
    found.push_back(engine::message("what would be the head has ",
                                    std::round(100.0 * shares.part(Part::kHead)), " % of the skin"));
  // A figure that stands may have flat parts in what it wears.
  if (const double flat = flat_share(skin, anatomy.up);
      flat > kMostFlat && (std::ranges::max(thigh_cosines(anatomy)) < kSitting || count_doubts(anatomy) > 0))
    found.push_back(
        engine::message(std::round(100.0 * flat), " % of its surface is as flat as furniture or a floor"));
  double trunk = 0.0;
  for (int p = 0; p < body::kPartCount; ++p)
    if (body::is_torso(static_cast<Part>(p))) trunk += shares.of[static_cast<std::size_t>(p)];
  if (!kTrunkShare.holds(trunk))
    found.push_back(
        engine::message("what would be the trunk has ", std::round(100.0 * trunk), " % of the skin"));
  if (count_doubts(anatomy) >= kTooManyDoubts && warned_of(anatomy, "unusual-body"))
    found.push_back(
        engine::message(count_doubts(anatomy), " of its landmarks are in doubt or contradict each other"));
  if (stays_welded(anatomy))
    found.push_back(engine::message("its arms and legs are both welded to something, and ",
                                    count_doubts(anatomy), " of its landmarks are in doubt"));
  check_limbs(shares, found);
  check_lengths(anatomy, found);
  return found;
}

}  // namespace bodice::anatomy
