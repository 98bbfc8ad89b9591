#include "measure/fit_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <bodice/engine/message.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

// kMissing_m: the length that a garment must lack to be too tight, because tailors allow up to a centimeter.
// kSlid_m: the distance that it must slide to be too loose, because any cloth settles by two or three
// centimeters.
constexpr double kMissing_m = 0.01, kSlid_m = 0.05;
// Beside a body that moves, cloth that is stretched by so much beyond its fabric's limit is caught between
// limbs or has passed one. No size would mend that.
constexpr double kCaught = 0.4;
// The least area of cloth on a part that is judged, that of a palm.
constexpr double kLeastArea_m2 = 0.01;
// The largest median gap of a garment that lies on the body.
constexpr double kOnBody_m = 0.04;

/// The length by which the garment is too short around a part: with so much more, its fabric would not be
/// stretched beyond its limit. Meters.
double missing_m(const PartEase& part, const cloth::Fabric& fabric) {
  return std::max(0.0, part.strain_mean - fabric.max_stretch) * part.girth_m;
}

double median_gap_m(std::span<const PartEase> parts) {
  double sum = 0.0, area = 0.0;
  for (const PartEase& p : parts) sum += p.area_m2 * p.gap_median_m, area += p.area_m2;
  return area > 0.0 ? sum / area : 0.0;
}

double slid_m(const GarmentBeforeAndAfter& worn) {
  const std::vector<geometry::Vec3>& start = worn.garment.mesh.positions;
  double sum = 0.0, count = 0.0;
  for (std::size_t v = 0; v < start.size(); ++v) {
    const double down = (start[v] - worn.positions[v]).dot(worn.up);
    if (std::isfinite(down)) sum += down, count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

long millimeters(double meters) {
  return std::lround(1e3 * meters);
}

/// The parts on which the garment is stretched beyond its fabric's limit.
struct StretchedParts {
  std::vector<PartEase> tight;   ///< it is too tight: the tightest first; of equals, the first part
  std::vector<PartEase> caught;  ///< it is caught: the most stretched first; of equals, the first part
};

StretchedParts stretched_parts(const GarmentBeforeAndAfter& worn, const cloth::Fabric& fabric) {
  StretchedParts found;
  for (const PartEase& part : worn.end) {
    if (part.area_m2 < kLeastArea_m2 || missing_m(part, fabric) < kMissing_m) continue;
    const bool caught = !worn.body_stood && part.strain_mean > fabric.max_stretch + kCaught;
    (caught ? found.caught : found.tight).push_back(part);
  }
  std::ranges::stable_sort(found.tight, std::greater<>(),
                           [&](const PartEase& part) { return missing_m(part, fabric); });
  std::ranges::stable_sort(found.caught, std::greater<>(), &PartEase::strain_mean);
  return found;
}

std::string tight_message(std::span<const PartEase> tight, const cloth::Fabric& fabric) {
  std::string text = engine::message(
      "The garment is too tight: around ", body::name(tight[0].part), " it lacks ",
      millimeters(missing_m(tight[0], fabric)), " mm (stretched by ", std::lround(1e2 * tight[0].strain_mean),
      " %, ", fabric.name, " yields by ", std::lround(1e2 * fabric.max_stretch), " %)");
  for (std::size_t k = 1; k < tight.size(); ++k)
    text += engine::message(k == 1 ? "; also around " : ", ", body::name(tight[k].part), " (",
                            millimeters(missing_m(tight[k], fabric)), " mm)");
  return text + ".";
}

std::string caught_message(std::span<const PartEase> caught) {
  std::string text =
      engine::message("The cloth is caught at ", body::name(caught[0].part), ", where it is stretched by ",
                      std::lround(1e2 * caught[0].strain_mean), " %");
  for (std::size_t k = 1; k < caught.size(); ++k)
    text += engine::message(k == 1 ? "; also at " : ", ", body::name(caught[k].part), " (",
                            std::lround(1e2 * caught[k].strain_mean), " %)");
  return text + ".";
}

}  // namespace

void warn_of_fit(const GarmentBeforeAndAfter& worn, const cloth::Fabric& fabric,
                 std::vector<engine::Warning>& warnings) {
  const StretchedParts stretched = stretched_parts(worn, fabric);
  if (!stretched.tight.empty())
    warnings.push_back({"too-tight", worn.garment.name, tight_message(stretched.tight, fabric),
                        "Take a larger size, or a fabric that yields more."});
  if (!stretched.caught.empty())
    warnings.push_back({"caught", worn.garment.name, caught_message(stretched.caught),
                        "The motion presses limbs together there. Take a fabric that yields more, as jersey "
                        "does, or a motion that leaves them room."});
  if (!worn.body_stood || median_gap_m(worn.start) > kOnBody_m) return;
  const double slid = slid_m(worn);
  if (slid > kSlid_m)
    warnings.push_back({"too-loose", worn.garment.name,
                        engine::message("The garment is too loose: it has slid down by ", millimeters(slid),
                                        " mm on average."),
                        "Take a smaller size, or hold it by its waistband."});
}

}  // namespace bodice::tryon
