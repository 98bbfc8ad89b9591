// Fits a BodyProxy to a labeled skin, in four tiers. The tier paper follows section 3 of the paper.
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

namespace bodice::inline v0_1::fitting {

/// The skin that a proxy is fitted to: a closed mesh with a part for each vertex, from any source of labels.
struct LabeledSkin {
  const geometry::TriMesh& mesh;
  std::span<const body::Part> part;                  ///< #V
  double stature_m = 0.0;                            ///< the scale of every tolerance; above 0
  geometry::Frame frame = {};                        ///< of the file the skin came from; stored in the proxy
  const geometry::MeshDistance* distance = nullptr;  ///< signed distances of `mesh`; null: built when needed
};

/// The ellipsoids of one region (the torso's six parts, or one other part) as soon as they are ready.
struct FittedPart {
  std::string_view name;    ///< "torso", or the part's name
  std::uint32_t parts = 0;  ///< a bit for each part of the region
  std::span<const proxy::ProxyEllipsoid> ellipsoids;
};

/// A bit for each part of bodies and things: the whole skin.
inline constexpr std::uint32_t kAllParts = (1u << body::kAllPartCount) - 1;

/// The promise that a fit should keep, and its limits. The defaults give tier relief with 89 ellipsoids.
struct FitOptions {
  /// Absent: the tier follows from the target error, the budget or the thresholds; without any of them,
  /// relief.
  std::optional<proxy::Tier> tier;
  /// Wanted mean gap. It gives the tier, the number of ellipsoids and the size of the tables. The target
  /// search aims within a tenth of it; a gap larger by more than a fifth is the warning
  /// target-error-not-reached.
  std::optional<double> target_error_m;
  /// Largest number of ellipsoids of the whole body, also where `parts` selects some regions only. Solid
  /// without thresholds uses at most 200, because its gap widens with more; tight may end with fewer.
  std::optional<int> max_ellipsoids;
  /// Wanted time of one query of 10,000 particles near the skin, microseconds; it gives tier and count. The
  /// cost model (predicted_frame_us) decides, within a fifth; beyond that there is the warning
  /// budget-not-reached. On a machine where a query takes twice the model's time, give half of your budget.
  std::optional<double> budget_us;
  /// The paper's thresholds at which splitting stops: both, or neither (the fit then finds them). They go
  /// with the tiers paper (the default with thresholds) and solid, and exclude a target error and a budget.
  std::optional<double> mu_torso_m, mu_limbs_m;
  /// The anytime tiers and the target search stop after this time. Absent: they stop after a number of steps
  /// and tries that is the same for every body, so that runs repeat.
  std::optional<double> time_budget_s;
  /// Tight: at the end the ellipsoids grow until no skin is outside, at the price of the mean gap.
  bool covering = false;
  /// The paper's eq. (8), tier paper only: it gains 0.2 mm of E for two to three times the work.
  bool reclassify_points = false;
  /// Relief: the same skin with its joints half bent (#V; binding::flexed_skin), for a body that will move.
  /// Its ellipsoids are found there, so that none spans a joint; tables and promises are those of the skin as
  /// it is. Empty: the ellipsoids are found on the skin as it is.
  std::span<const geometry::Vec3> flexed = {};
  /// Whether FitResult's accuracy and the parts' gaps are measured. Without this they stay zero, which saves
  /// about 20 ms of work; with a target error they are measured all the same.
  bool measure_accuracy = true;
  /// A bit a part: only regions that have one of these parts are fitted. They get the share of the ellipsoids
  /// that they have in a fit of the whole body; paper and solid give them the same bits as there.
  std::uint32_t parts = kAllParts;
  /// Called with each better proxy of an anytime tier, from the calling thread's task. Under a target error
  /// it is called in the first try only, because every other try starts over.
  std::function<void(const proxy::BodyProxy&)> on_improved;
  /// Paper and solid: called with each region once it and the regions before it are fitted, one call at a
  /// time, in the order of the parts (the torso as its first part), from any worker. The result has the same
  /// ellipsoids, unless closing the interior grows some (solid) or a target error leads to another count.
  std::function<void(const FittedPart&)> on_part;
};

/// Mean, 95th percentile and maximum of a quantity.
struct Spread {
  double mean = 0.0, p95 = 0.0, max = 0.0;
};

/// The paper's E_j, eq. (6), over the clusters of one part.
struct ClusterError {
  double mean_m = 0.0;  ///< mean of the clusters' E_j; each cluster counts once
  double max_m = 0.0;   ///< at most the threshold mu in force; else the warning thresholds-not-reached
};

/// The result for one part: its size and its errors. A region's ellipsoid counts for the part of most of its
/// cluster.
struct PartFit {
  body::Part part = body::Part::kHead;
  std::size_t vertices = 0;
  std::size_t ellipsoids = 0;
  /// E_j as they were when splitting stopped. Only tiers with clusters have it: paper, and solid with
  /// thresholds.
  std::optional<ClusterError> cluster_error;
  /// Mean radial error over all the part's vertices, each by the ellipsoid of the part that is nearest along
  /// its ray. Every tier has it; it is no E_j, because a vertex may be nearest to the ellipsoid of another
  /// cluster.
  double radial_error_mean_m = 0.0;
  /// The largest of the ellipsoids' mean radial errors over the vertices nearest to them; it may exceed mu.
  double radial_error_max_m = 0.0;
  Spread gap_m;  ///< distance between the proxy's surface and the skin
};

/// How well the whole proxy follows the skin, measured against the exact signed distance to the mesh.
struct FitAccuracy {
  Spread gap_m;                           ///< over the proxy's surface, by area
  double interior_covered_percent = 0.0;  ///< share of interior sample points that lie inside the proxy
  double skin_outside_percent = 0.0;      ///< share of the skin's area that lies outside the proxy
  double skin_outside_depth_m = 0.0;      ///< largest distance from such skin to the proxy
};

/// A proxy and how it was made.
struct FitResult {
  proxy::BodyProxy proxy;
  double mu_torso_m = 0.0, mu_limbs_m = 0.0;  ///< thresholds in force; zero for tiers without clusters
  std::vector<PartFit> parts;                 ///< one for each fitted part that has skin
  FitAccuracy accuracy;
  std::vector<engine::Warning> warnings;
  std::vector<engine::StageTime> stages;  ///< fit, tight, relief, measure
};

/// Fits a proxy to a skin. Fails with kInvalidArgument (options or labels that do not fit), kUnusableGeometry
/// (no triangles, no skin in the selected parts) or kCanceled. The same bits for any worker count, unless a
/// time budget cuts an anytime tier short. Time for 8,500 vertices and 89 ellipsoids on two cores: 10 ms
/// (paper, solid), 0.8 s (tight), 1.5 s (relief).
engine::Result<FitResult> fit(const engine::Context& context, const LabeledSkin& skin,
                              const FitOptions& options);

}  // namespace bodice::fitting
