#include "base/check_input.hpp"

#include <cmath>
#include <string>

namespace bodice::inline v0_1::fitting {
namespace {

engine::Error bad(std::string message, std::string remedy) {
  return {engine::ErrorCode::kInvalidArgument, std::move(message), std::move(remedy)};
}

bool positive(const std::optional<double>& value) {
  return !value || (std::isfinite(*value) && *value > 0.0);
}

engine::Result<void> check_thresholds(const FitOptions& options) {
  if (!positive(options.mu_torso_m) || !positive(options.mu_limbs_m))
    return bad("A threshold mu is not positive.", "Give meters above 0, or leave it out.");
  if (options.mu_torso_m.has_value() != options.mu_limbs_m.has_value())
    return bad("One of the two thresholds mu is missing.", "Give the torso's and the limbs', or neither.");
  if (!options.mu_torso_m) return {};
  if (options.tier.value_or(proxy::Tier::kPaper) > proxy::Tier::kSolid)
    return bad("The thresholds mu do not apply to the tier " + std::string(proxy::name(*options.tier)) + ".",
               "Choose paper or solid, or leave the thresholds out.");
  if (options.target_error_m || options.budget_us)
    return bad("The thresholds mu and a target error or a budget both say how many ellipsoids there are.",
               "Give one of them.");
  return {};
}

engine::Result<void> check_options(const FitOptions& options) {
  if (options.max_ellipsoids && (*options.max_ellipsoids < 1 || *options.max_ellipsoids > 10000))
    return bad("max_ellipsoids is " + std::to_string(*options.max_ellipsoids) + ".", "Ask for 1 to 10000.");
  if (!positive(options.target_error_m))
    return bad("target_error_m is not positive.", "Give meters above 0.");
  if (!positive(options.budget_us)) return bad("budget_us is not positive.", "Give microseconds above 0.");
  if (auto good = check_thresholds(options); !good) return good;
  if (options.time_budget_s && !(*options.time_budget_s >= 0.0))
    return bad("time_budget_s is negative or NaN.", "Give seconds.");
  if ((options.parts & ((1u << body::kAllPartCount) - 1)) == 0)
    return bad("No part is selected.", "Set at least one bit of parts.");
  return {};
}

}  // namespace

engine::Result<void> check_input(const LabeledSkin& skin, const FitOptions& options) {
  if (auto ok = check_options(options); !ok) return ok;
  const std::size_t n = skin.mesh.positions.size();
  if (skin.part.size() != n)
    return bad(
        "There are " + std::to_string(skin.part.size()) + " labels for " + std::to_string(n) + " vertices.",
        "Give one part a vertex.");
  if (!options.flexed.empty() && options.flexed.size() != n)
    return bad("The flexed skin has " + std::to_string(options.flexed.size()) + " vertices for " +
                   std::to_string(n) + ".",
               "Give the same skin, posed, or none.");
  for (const geometry::Vec3& position : options.flexed)
    if (!position.allFinite()) return bad("The flexed skin is not finite.", "Pose it by finite matrices.");
  if (skin.mesh.triangles.empty())
    return engine::Error{engine::ErrorCode::kUnusableGeometry, "The skin has no triangles.",
                         "Give a closed triangle mesh."};
  if (!(std::isfinite(skin.stature_m) && skin.stature_m > 0.0))
    return bad("stature_m is not positive.", "Give the body's standing height in meters.");
  for (std::size_t v = 0; v < n; ++v) {
    if (!skin.mesh.positions[v].allFinite())
      return bad("Vertex " + std::to_string(v) + " is not finite.",
                 "Repair the mesh first (geometry::repair).");
    if (static_cast<int>(skin.part[v]) >= body::kAllPartCount)
      return bad("Vertex " + std::to_string(v) + " has an unknown part.",
                 "Use the parts that body::name() has a name for.");
  }
  for (std::size_t t = 0; t < skin.mesh.triangles.size(); ++t)
    for (const geometry::Index v : skin.mesh.triangles[t])
      if (v >= n)
        return bad("Triangle " + std::to_string(t) + " names vertex " + std::to_string(v) + " of " +
                       std::to_string(n) + ".",
                   "Repair the mesh first (geometry::repair).");
  return {};
}

engine::Error no_skin() {
  return {engine::ErrorCode::kUnusableGeometry, "The selected parts have no skin.",
          "Select parts that occur among the labels."};
}

}  // namespace bodice::fitting
