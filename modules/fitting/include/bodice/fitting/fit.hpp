// From a labeled skin to a BodyProxy: the paper's section 3 and what it lacks.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::fitting {

/// The skin to stand for: a closed mesh, a part a vertex. Labels may come from anywhere.
struct LabeledSkin {
  const geometry::TriMesh& mesh;
  std::span<const body::Part> part;  ///< #V
  double stature_m = 0.0;
  geometry::Frame frame = {};  ///< of the file the skin came from; passed on to the proxy
  const geometry::MeshDistance* distance =
      nullptr;  ///< of `mesh`, if the caller has it; else built when needed
};

/// A region of the body (the torso's six parts, or one limb part) whose ellipsoids are ready.
struct FittedPart {
  std::string_view name;    ///< "torso", or the part's name
  std::uint32_t parts = 0;  ///< bit a part
  std::span<const proxy::ProxyEllipsoid> ellipsoids;
};

inline constexpr std::uint32_t kAllParts = (1u << body::kPartCount) - 1;

struct FitOptions {
  std::optional<proxy::Tier> tier;  ///< absent: what the target error or the budget asks for, else relief
  /// Mean gap wanted: gives tier, count, size of tables and thresholds. The search aims within a tenth of it;
  /// a gap above it by more than a fifth is the warning target-error-not-reached.
  std::optional<double> target_error_m;
  /// Of the whole body, whatever `parts` says. Solid without thresholds uses 200 at most, with more of which
  /// its gap would widen; tight may end with some fewer.
  std::optional<int> max_ellipsoids;
  /// Time of one query of 10,000 particles near the skin, microseconds: gives tier and count, kept within a
  /// fifth (more is the warning budget-not-reached). Judged by a law (predicted_frame_us) and no clock, so
  /// that results repeat: one thread of a 2.5 GHz server with AVX-512, nothing kept from an earlier query.
  /// Where a query takes twice the law's time, ask for half.
  std::optional<double> budget_us;
  /// The paper's thresholds, both or neither (automatic then): they say where splitting stops, so that they
  /// go with the tiers paper (if none is asked for) and solid, and without a target or a budget.
  std::optional<double> mu_torso_m, mu_limbs_m;
  /// The anytime tiers and the search for a target stop after this long; absent: after a number of steps and
  /// of tries that is the same for every body, so that runs repeat.
  std::optional<double> time_budget_s;
  /// Tight: the ellipsoids grow in the end until no skin is outside, at the price of the mean gap.
  bool covering = false;
  bool reclassify_points = false;  ///< the paper tier's eq. (8): .2 mm of E for two to three times the work
  /// False: FitResult's accuracy and the parts' gaps stay zero, which saves some 20 ms of work where nobody
  /// reads them. A target error is measured all the same.
  bool measure_accuracy = true;
  /// Bit a part: only regions that have one of these are fitted. Their share of the ellipsoids is the one
  /// they have in a fit of the whole body, and paper and solid give them the same bits as there.
  std::uint32_t parts = kAllParts;
  /// Called with each better proxy of an anytime tier, from the calling thread's task. Under a target error
  /// the first try's are told: another try starts over.
  std::function<void(const proxy::BodyProxy&)> on_improved;
  /// Paper and solid: called with each region once it and those before it are fitted: one call at a time,
  /// in the order of the parts (the torso as its first), from any worker. What it shows is in the result,
  /// unless the inside of the whole body asks for a little more (solid) or a target error for another count.
  std::function<void(const FittedPart&)> on_part;
};

struct Spread {
  double mean = 0.0, p95 = 0.0, max = 0.0;
};

struct PartFit {
  body::Part part = body::Part::kHead;
  std::size_t vertices = 0;
  std::size_t ellipsoids = 0;
  /// Eq. (6) over all the part's vertices, each by the ellipsoid of the part that is nearest along its ray;
  /// the paper's E_j are means over one cluster each.
  double radial_error_mean_m = 0.0;
  double radial_error_max_m = 0.0;  ///< the worst ellipsoid's mean over the vertices nearest to it
  Spread gap_m;                     ///< distance between the proxy's surface and the skin
};

/// Against the exact signed distance to the skin, never against the proxy.
struct FitAccuracy {
  Spread gap_m;
  double interior_covered_percent = 0.0;  ///< of interior sample points inside the proxy
  double skin_outside_percent = 0.0;      ///< of the skin's area outside the proxy
  double skin_outside_depth_m = 0.0;      ///< deepest such skin, as distance to the proxy
};

struct FitResult {
  proxy::BodyProxy proxy;
  double mu_torso_m = 0.0, mu_limbs_m = 0.0;  ///< in force
  std::vector<PartFit> parts;
  FitAccuracy accuracy;
  std::vector<engine::Warning> warnings;
  std::vector<engine::StageTime> stages;  ///< fit, tight, relief, measure
};

/// Deterministic for any worker count, except that a time budget that cuts an anytime tier short is time's.
engine::Result<FitResult> fit(const engine::Context& context, const LabeledSkin& skin,
                              const FitOptions& options);

}  // namespace bodice::fitting
