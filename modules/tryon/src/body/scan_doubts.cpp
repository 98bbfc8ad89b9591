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

/// The surroundings of a landmark are the skin no more than this farther away than the nearest skin; a
/// fraction of the stature.
constexpr double kSurroundings = 0.03;
/// A landmark with confidence 1 gets the warning if this share of its surroundings is made up. The share
/// falls in proportion to the confidence.
constexpr double kMadeUpShare = 0.4;
/// With more than this share made up, the landmark may be wrong. With less, the rest of its surroundings
/// determines it, and the warning is a note.
constexpr double kMostlyMadeUp = 0.7;
/// The largest difference of both limbs of one body, also where one is bent; a fraction of the stature.
constexpr double kMostDifference = 0.03;
/// The least product of the confidences of both armpits and the crotch. Of 76 scans that were read right none
/// has less than .59; two in which webs hid all three folds had .21 and .30.
constexpr double kFoldsFit = 0.4;
/// The number of main landmarks. Those after them serve tailors and lie near the main ones, so that they are
/// not tested.
constexpr std::size_t kMainLandmarks = 13;

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

/// The distance from one landmark to another, as a fraction of the stature; NaN if one was not found.
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
  bool mostly = false;
  for (std::size_t i = 0; i < kMainLandmarks; ++i) {
    const body::Landmark& mark = anatomy.landmarks[i];
    if (mark.confidence <= 0.0) continue;
    const double share = made_up_share(mesh, mark.position, kSurroundings * anatomy.stature_m);
    if (share < kMadeUpShare * mark.confidence) continue;
    mostly = mostly || share > kMostlyMadeUp;
    names += (names.empty() ? "" : ", ") + std::string(body::name(mark.id));
  }
  if (names.empty()) return;
  warnings.push_back(
      {"landmarks-made-up", "",
       "Much of the skin around these landmarks is not in the file, and closes holes: " + names + ".",
       "Scan from more sides, also from below.", !mostly && !doubts_landmarks(anatomy)});
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

/// Webs of a scan change all three folds alike, so that each single fold may still look right.
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
  if (anatomy.landmarks.size() < kMainLandmarks) return;  // a thing has no landmarks
  if (!mesh.made_up.empty() || mesh.noise_m > 0.0) warn_of_folds(anatomy, warnings);
  if (mesh.made_up.empty()) return;
  warn_of_made_up(mesh, anatomy, warnings);
  warn_of_unequal_limbs(anatomy, warnings);
}

}  // namespace bodice::tryon
