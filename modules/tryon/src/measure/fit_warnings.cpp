#include "measure/fit_warnings.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/message.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

// What counts as missing, and what as slid: a centimeter is within what tailors allow, and cloth settles by
// two or three.
constexpr double kMissing_m = 0.01, kSlid_m = 0.05;
// A part counts with this much cloth on it: a hand's palm.
constexpr double kLeastArea_m2 = 0.01;
// A garment lay on the body where its median gap was at most this.
constexpr double kOnBody_m = 0.04;

/// The length around that the garment lacks on a part so that its fabric would not be stretched beyond the
/// limit.
double missing_m(const PartEase& part, const cloth::Fabric& fabric) {
  return std::max(0.0, part.strain_mean - fabric.max_stretch) * part.girth_m;
}

double median_gap_m(std::span<const PartEase> parts) {
  double sum = 0.0, area = 0.0;
  for (const PartEase& p : parts) sum += p.area_m2 * p.gap_median_m, area += p.area_m2;
  return area > 0.0 ? sum / area : 0.0;
}

double slid_m(const WornThen& worn) {
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

}  // namespace

void warn_of_fit(const WornThen& worn, const cloth::Fabric& fabric, std::vector<engine::Warning>& warnings) {
  const PartEase* tightest = nullptr;
  std::size_t tight = 0;
  for (const PartEase& part : worn.end) {
    if (part.area_m2 < kLeastArea_m2 || missing_m(part, fabric) < kMissing_m) continue;
    ++tight;
    if (!tightest || missing_m(part, fabric) > missing_m(*tightest, fabric)) tightest = &part;
  }
  if (tightest)
    warnings.push_back(
        {"too-tight", worn.garment.name,
         engine::message(
             "The garment is too tight: around ", body::name(tightest->part), " it lacks ",
             millimeters(missing_m(*tightest, fabric)), " mm (stretched by ",
             std::lround(1e2 * tightest->strain_mean), " %, ", fabric.name, " yields by ",
             std::lround(1e2 * fabric.max_stretch), " %)",
             tight > 1 ? engine::message("; ", tight, " parts are too tight.") : std::string(".")),
         "Take a larger size, or a fabric that yields more."});
  if (!worn.body_stood || median_gap_m(worn.start) > kOnBody_m) return;
  const double slid = slid_m(worn);
  if (slid > kSlid_m)
    warnings.push_back({"too-loose", worn.garment.name,
                        engine::message("The garment is too loose: it has slid down by ", millimeters(slid),
                                        " mm on average."),
                        "Take a smaller size, or hold it by its waistband."});
}

}  // namespace bodice::tryon
