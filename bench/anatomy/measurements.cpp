#include "measurements.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <bodice/anatomy/measure.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/synth/body.hpp>

namespace bench {
namespace {

using bodice::body::MeasurementId;

/// A grown-up of random build, thin to very heavy.
bodice::synth::BodyOptions standing(std::uint64_t seed) {
  bodice::engine::Random random(seed, 26);
  bodice::synth::BodyOptions o;
  o.sex = random.below(2) == 0 ? bodice::body::Sex::kFemale : bodice::body::Sex::kMale;
  o.stature_m = random.uniform(1.5, 1.95);
  o.mass_kg = random.uniform(18.0, 38.0) * o.stature_m * o.stature_m;
  o.vertices = static_cast<int>(random.uniform(4000.0, 12000.0));
  o.seed = seed + 1;
  return o;
}

/// Errors of one measurement over all bodies, in millimeters or degrees.
struct Errors {
  std::vector<double> of_body;
  double truth = 0.0, signed_sum = 0.0;
};

void print_row(MeasurementId id, Errors& e) {
  if (e.of_body.empty()) return;
  std::sort(e.of_body.begin(), e.of_body.end());
  const auto n = static_cast<double>(e.of_body.size());
  double mean = 0.0;
  for (const double error : e.of_body) mean += error / n;
  std::printf("%-22s %8.1f %7.1f %7.1f %7.1f %7.1f\n", std::string(bodice::body::name(id)).c_str(),
              e.truth / n, mean, e.signed_sum / n, e.of_body[e.of_body.size() * 95 / 100], e.of_body.back());
}

}  // namespace

void print_measurement_errors(std::uint64_t from, std::uint64_t count) {
  std::array<Errors, bodice::body::kMeasurementCount> errors;
  for (std::uint64_t seed = from; seed < from + count; ++seed) {
    const auto body = bodice::synth::make_body({}, standing(seed));
    if (!body) continue;
    const auto anatomy =
        bodice::anatomy::analyze({}, body->mesh, {bodice::body::find_profile("ansur2").value()});
    if (!anatomy) continue;
    const auto found = bodice::anatomy::measure(body->mesh, *anatomy);
    for (int i = 0; i < bodice::body::kMeasurementCount; ++i) {
      const double unit = is_angle(static_cast<MeasurementId>(i)) ? 180.0 / std::numbers::pi : 1e3;
      const double off = unit * (found.value[i] - body->measurements.value[i]);
      if (!std::isfinite(off)) continue;
      errors[i].of_body.push_back(std::abs(off));
      errors[i].signed_sum += off;
      errors[i].truth += unit * body->measurements.value[i];
    }
  }
  std::printf("%-22s %8s %7s %7s %7s %7s   mm or degrees\n", "measurement", "truth", "error", "bias", "p95",
              "worst");
  for (int i = 0; i < bodice::body::kMeasurementCount; ++i)
    print_row(static_cast<MeasurementId>(i), errors[i]);
}

}  // namespace bench
