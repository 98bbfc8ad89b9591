#include "base/check_options.hpp"

#include <cmath>
#include <string>

#include <bodice/engine/message.hpp>

namespace bodice::inline v0_1::cloth {
namespace {

constexpr double kMostMeters = 1e9;  // squares of larger lengths would overflow in float
constexpr int kMaxIterations = 64;

engine::Error bad(const std::string& what, const std::string& remedy) {
  return {engine::ErrorCode::kInvalidArgument, "Solver option " + what + ".", remedy};
}

engine::Result<void> check_count(const char* name, int value, int most) {
  if (value >= 1 && value <= most) return {};
  return bad(name + (" is " + std::to_string(value)), "Choose 1 to " + std::to_string(most) + ".");
}

}  // namespace

engine::Result<void> check(const Environment& e) {
  if (e.gravity_m_s2.allFinite() && e.wind_m_s.allFinite() && std::isfinite(e.gust) &&
      e.air_density_kg_m3 >= 0.0 && std::isfinite(e.air_density_kg_m3))
    return {};
  return bad("environment has a value that is not finite or a negative air density", "Give finite values.");
}

engine::Result<void> check(const SolverOptions& o) {
  if (auto good = check_count("substeps", o.substeps, kMaxSubsteps); !good) return good;
  if (auto good = check_count("iterations", o.iterations, kMaxIterations); !good) return good;
  if (!(o.thickness_m >= 0.0 && o.thickness_m <= kMostMeters))
    return bad(engine::message("thickness_m is ", o.thickness_m), "Give meters, 0 to 1e9.");
  if (!(o.layer_gap_m >= 0.0 && o.layer_gap_m <= kMostMeters))
    return bad(engine::message("layer_gap_m is ", o.layer_gap_m), "Give meters, 0 to 1e9.");
  if (o.certify_m && !(*o.certify_m > 0.0 && *o.certify_m <= kMostMeters))
    return bad(engine::message("certify_m is ", *o.certify_m), "Give meters above zero, up to 1e9, or none.");
  if (!(o.budget_us >= 0.0)) return bad(engine::message("budget_us is ", o.budget_us), "Give zero or more.");
  return check(o.environment);
}

}  // namespace bodice::cloth
