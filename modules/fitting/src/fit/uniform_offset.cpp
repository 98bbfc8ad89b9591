#include "fit/uniform_offset.hpp"

#include <cmath>

#include "plan/plan.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr double kMostRatio =
    3.0;  // target to gap: the first ellipsoid of a limb lowers the gap up to 2.5 times
constexpr int kOffsetSteps = 10;

proxy::BodyProxy::Data grown_by(proxy::BodyProxy::Data data, double length_m) {
  for (auto& e : data.ellipsoids) e.shape.radii.array() += length_m;
  return data;
}

}  // namespace

void grow_to_target(const engine::Context& context, const LabeledSkin& skin, std::uint32_t parts,
                    double target_m, proxy::BodyProxy::Data& data, Measured& measured) {
  const double gap_m = measured.accuracy.gap_m.mean;
  if (!(kNearTarget * gap_m < target_m && target_m < kMostRatio * gap_m)) return;
  // Half of a tight proxy's surface lies under the skin, so that the gap at first grows less than the
  // ellipsoids.
  double low = 0.0, high = 2.0 * target_m;
  for (int step = 0; step < kOffsetSteps; ++step) {
    const double length_m = 0.5 * (low + high);
    const proxy::BodyProxy::Data grown = grown_by(data, length_m);
    const Measured now = measure(context, grown, skin, *skin.distance, parts);
    const double reached_m = now.accuracy.gap_m.mean;
    if (reached_m < kNearTarget * target_m && target_m < kNearTarget * reached_m) {
      data = grown;
      measured = now;
      return;
    }
    (reached_m < target_m ? low : high) = length_m;
  }
}

}  // namespace bodice::fitting
