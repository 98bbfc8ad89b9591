#include "body/scan_doubts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace bodice::inline v0_1::tryon {
namespace {

using body::LandmarkId;
using geometry::Vec3;

/// Skin this much farther from a landmark than the nearest skin is around it; a fraction of the stature.
constexpr double kAround = 0.03;
/// A landmark is made up with the skin where so much of that is; one in doubt, in proportion, where less is.
constexpr double kMostly = 0.4;
/// Where this much of the skin is made up, the landmark may be wrong. Where less is, its surroundings hold
/// it.
constexpr double kWholly = 0.7;
/// Limbs of one body differ by less, a fraction of the stature, also where one of them is bent.
constexpr double kMostDifference = 0.03;
/// The least product of the confidences of both armpits and the crotch. Of 76 scans that were read right none
/// has less than .59; two in which webs hid all three folds had .21 and .30.
constexpr double kFoldsFit = 0.4;
/// Landmarks from here on serve tailors; they lie where the others do.
constexpr std::size_t kMain = 13;

/// The share of made-up vertices around a point.
double made_up_share(const io::ImportedMesh& mesh, const Vec3& point, double around_m) {
  const std::vector<Vec3>& positions = mesh.skin.positions;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : positions) nearest = std::min(nearest, (p - point).norm());
  std::size_t all = 0, made_up = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if ((positions[v] - point).norm() > nearest + around_m) continue;
    ++all;
    made_up += mesh.made_up[v];
  }
  return all > 0 ? static_cast<double>(made_up) / static_cast<double>(all) : 0.0;
}

/// From one landmark of a limb to the next, as a fraction of the stature.
double length(const anatomy::Anatomy& anatomy, LandmarkId from, LandmarkId to) {
  const body::Landmark &a = anatomy.landmarks[static_cast<std::size_t>(from)],
                       &b = anatomy.landmarks[static_cast<std::size_t>(to)];
  return a.confidence > 0.0 && b.confidence > 0.0 ? (a.position - b.position).norm() / anatomy.stature_m
                                                  : std::numeric_limits<double>::quiet_NaN();
}

bool doubts_landmarks(const anatomy::Anatomy& anatomy) {
  return std::ranges::any_of(anatomy.warnings, [](const engine::Warning& w) {
    return w.code.ends_with("-uncertain") || w.code.ends_with("-disagrees");
  });
}

void warn_of_made_up(const io::ImportedMesh& mesh, const anatomy::Anatomy& anatomy,
                     std::vector<engine::Warning>& warnings) {
  std::string names;
  bool wholly = false;
  for (std::size_t i = 0; i < kMain; ++i) {
    const body::Landmark& mark = anatomy.landmarks[i];
    if (mark.confidence <= 0.0) continue;
    const double share = made_up_share(mesh, mark.position, kAround * anatomy.stature_m);
    if (share < kMostly * mark.confidence) continue;
    wholly = wholly || share > kWholly;
    names += (names.empty() ? "" : ", ") + std::string(body::name(mark.id));
  }
  if (names.empty()) return;
  warnings.push_back(
      {"landmarks-made-up", "",
       "Much of the skin around these landmarks is not in the file, and closes holes: " + names + ".",
       "Scan from more sides, also from below.", !wholly && !doubts_landmarks(anatomy)});
}

void warn_of_unequal_limbs(const anatomy::Anatomy& anatomy, std::vector<engine::Warning>& warnings) {
  struct Limb {
    const char* name;
    LandmarkId from, to;
  };
  using enum LandmarkId;
  constexpr std::array kLimbs = {Limb{"forearm with its hand", kElbowL, kFingertipL},
                                 Limb{"lower leg with its foot", kKneeL, kToeL}};
  for (const Limb& limb : kLimbs) {
    const double left = length(anatomy, limb.from, limb.to),
                 right = length(anatomy, body::of_side(limb.from, 1), body::of_side(limb.to, 1));
    if (!(std::abs(left - right) > kMostDifference)) continue;
    const long mm = std::lround(1000.0 * std::abs(left - right) * anatomy.stature_m);
    warnings.push_back({"limbs-unequal", "",
                        std::string("The ") + (left > right ? "right " : "left ") + limb.name + " is " +
                            std::to_string(mm) + " mm shorter than the other one.",
                        "Check the ends of both; a hole may have taken the tip of one."});
  }
}

/// Webs of a scan change all three folds alike, so that each may still look like one.
void warn_of_folds(const anatomy::Anatomy& anatomy, std::vector<engine::Warning>& warnings) {
  double fit = 1.0;
  for (const LandmarkId id : {LandmarkId::kArmpitL, LandmarkId::kArmpitR, LandmarkId::kPerineum})
    fit *= anatomy.landmarks[static_cast<std::size_t>(id)].confidence;
  if (fit >= kFoldsFit || doubts_landmarks(anatomy)) return;
  warnings.push_back(
      {"folds-uncertain", "",
       "Neither the armpits nor the crotch look as they do on known bodies; skin that has grown together "
       "may hide them.",
       "Check these borders in the result; a pose with arms and legs apart shows them."});
}

}  // namespace

void warn_of_scan(const io::ImportedMesh& mesh, const anatomy::Anatomy& anatomy,
                  std::vector<engine::Warning>& warnings) {
  if (anatomy.landmarks.size() < kMain) return;  // a thing has no landmarks
  if (!mesh.made_up.empty() || mesh.noise_m > 0.0) warn_of_folds(anatomy, warnings);
  if (mesh.made_up.empty()) return;
  warn_of_made_up(mesh, anatomy, warnings);
  warn_of_unequal_limbs(anatomy, warnings);
}

}  // namespace bodice::tryon
