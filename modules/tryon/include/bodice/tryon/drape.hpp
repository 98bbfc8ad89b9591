// Drapes garments on a prepared body, and measures the result against the true skin.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <bodice/cloth/solver.hpp>
#include <bodice/io/scene.hpp>
#include <bodice/proxy/base_pose.hpp>
#include <bodice/tryon/ease.hpp>
#include <bodice/tryon/fit_map.hpp>
#include <bodice/tryon/judge_frame.hpp>
#include <bodice/tryon/motion.hpp>
#include <bodice/tryon/prepare.hpp>
#include <bodice/tryon/prop.hpp>
#include <bodice/tryon/wardrobe.hpp>

namespace bodice::inline v0_1::tryon {

/// Length and detail of a drape.
struct DrapeOptions {
  int frames = 120;          ///< number of frames, 1 or more
  double dt_s = 1.0 / 60.0;  ///< length of a frame, 0 or more
  int kept_frames = 31;      ///< most frames that are kept for output, first and last included; 2 or more
  std::optional<cloth::Fabric> fabric;  ///< absent: cotton
  /// Options of the solver. Two of them are replaced: thickness_m by the member below, and for a proxy of
  /// tier paper the response by the paper's. Two sweeps keep the 95th percentile of cotton's stretch under 5
  /// %.
  cloth::SolverOptions solver = {
      .substeps = 16, .iterations = 2, .doubled_when_stretched = true, .pins_yield = true};
  /// Distance that cloth keeps from the proxy, meters. Absent: known_thickness_m(); on a moving body, the
  /// larger of it and the same over poses of the clip.
  std::optional<double> thickness_m;
  /// The motion of the body; if it is null, the body stands still. Garments are put on in the bind pose; a
  /// ramp that is not part of the result brings them to the clip's first frame. Frame k then shows second k
  /// dt_s of the clip.
  const BodyMotion* motion = nullptr;
  std::optional<double> ramp_s;  ///< zero or more; absent: suggested_ramp_s()
  /// Whether the proxy's tables are solved anew along the clip before its first frame (make_base_poses()),
  /// which takes some tenths of a second for each base pose. Otherwise tables are carried from rest, and
  /// their error is larger by a fifth.
  bool prepare_clip = true;
  /// Whether the clip starts over after its end. Where its end is not its start, a seam leads back, which
  /// lengthens each lap (closed_loop()). If false, the last pose holds.
  bool loop = false;
  /// Pieces of a garment that are at most this far apart at the start are tacked together, meters; 0: none
  /// is.
  double tack_m = kTackWithin_m;
  /// Names of garments from the body outward. Each is laid over those before it (order_layers()). Empty:
  /// garments stay as they are.
  std::vector<std::string> order;
  /// Things beside the body with which garments collide. They do not move, and must outlive the drape. A
  /// moving body passes through them.
  std::span<const PreparedBody> props = {};
  std::optional<FitMap> fit_map;  ///< colors the garments by how they fit at the last frame
};

/// The part of a report that concerns one garment.
struct DrapedGarment {
  std::string name;
  std::size_t vertices = 0, held = 0;
  std::vector<PartEase> ease;       ///< gap and strain at the end, by part of the body
  std::vector<TackedPiece> tacked;  ///< pieces that threads hold together
};

/// One kept frame of a moving body, measured against the posed skin.
struct KeptFrame {
  double time_s = 0.0;             ///< of the clip
  ProxyError proxy_error;          ///< within 30 mm of the skin
  double penetration_max_m = 0.0;  ///< deepest particle
  ClothInside inside;              ///< area of cloth more than half a millimeter inside the skin
};

/// The numbers of a drape. Penetration is measured by the exact signed distance to the skin, never to the
/// proxy.
struct DrapeReport {
  int frames = 0;
  std::size_t particles = 0;
  double frame_ms_median = 0.0, frame_ms_p99 = 0.0, frame_ms_max = 0.0;
  std::size_t penetration_over_1mm = 0;  ///< particles deeper than 1 mm at the last frame
  double penetration_max_m = 0.0;        ///< deepest particle of any frame
  double penetration_end_m = 0.0;        ///< deepest particle at the last frame
  double thickness_m = 0.0;              ///< distance that particles kept from the proxy
  int worst_frame = 0;
  std::vector<double> penetration_of_frame_m;  ///< deepest particle of each frame, #frames
  double pierced_share = 0.0;                  ///< share of the cloth's area inside the skin at the end
  /// Pairs of triangles of the cloth that cross: in the garments that were given, those of them that
  /// separate_layers() separated before the first frame, and at the end.
  std::size_t crossings_start = 0, crossings_separated = 0, crossings_end = 0;
  std::size_t inside_union = 0;                 ///< particles inside the proxy at the end: count_inside()
  double stretch_p95 = 0.0, stretch_max = 0.0;  ///< edge strain at the end
  double median_speed_m_s = 0.0;                ///< at the end
  bool finite = true;                           ///< whether all positions of all frames were finite
  std::uint64_t hash = 0;                       ///< hash of the final state, equal for any number of workers
  /// Largest move of a vertex out of a proxy that is wider than the skin, at the start.
  double lifted_m = 0.0;
  double ramp_s = 0.0;          ///< from the bind pose to the clip's first frame
  std::size_t base_poses = 0;   ///< number of poses along the clip for which tables were solved anew
  std::vector<KeptFrame> kept;  ///< the kept frames of a body that moves
  std::vector<DrapedGarment> garments;
  std::vector<PropReport> props;
  std::optional<FitScale> fit_map;  ///< scale of the garments' colors, where they have one
  std::string fabric;               ///< name of the fabric; dt_s and substeps are those of the run
  double dt_s = 0.0;
  int substeps = 0;
  std::vector<engine::StageTime> stages;  ///< "drape"
  std::vector<engine::Warning> warnings;
};

/// The draped garments over time, and the numbers of the drape.
struct DrapeResult {
  std::vector<io::GarmentTrack> garments;
  rig::Clip clip;  ///< the clip of all frames, with laps and seams; empty if the body stands still
  std::vector<std::vector<geometry::Vec3>> body_frames;  ///< skin of a body that moves at each kept frame, #V
  std::vector<std::vector<geometry::Ellipsoid>> proxy_frames;  ///< its ellipsoids at each kept frame, #E
  proxy::BasePoses
      bases;  ///< base poses of the part of the clip that was played; empty if it was not prepared
  /// Proxy of the body and props together, with which cloth collided; absent without props.
  std::optional<proxy::BodyProxy> proxy;
  DrapeReport report;
};

/// Drapes all garments together. Fails with kUnusableGeometry when no garment has a usable triangle; with
/// kInvalidArgument when an option is out of its range or a garment refers to a vertex that it does not have;
/// with kCanceled. The results have the same bits for any number of workers, times excepted. Cost: #frames
/// times that of cloth::Solver::step(), and one exact signed distance a particle and frame.
engine::Result<DrapeResult> drape(const engine::Context& context, const PreparedBody& body,
                                  const std::vector<WornGarment>& garments, const DrapeOptions& options,
                                  const Progress& progress = {});

}  // namespace bodice::tryon
