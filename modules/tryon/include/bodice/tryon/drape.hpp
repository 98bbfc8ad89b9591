// A prepared body and garments in, draped garments and an honest account of the true skin out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <bodice/cloth/solver.hpp>
#include <bodice/io/scene.hpp>
#include <bodice/tryon/prepare.hpp>
#include <bodice/tryon/wardrobe.hpp>

namespace bodice::tryon {

struct DrapeOptions {
  int frames = 120;          ///< 1 or more
  double dt_s = 1.0 / 60.0;  ///< a frame, 0 or more
  int kept_frames = 31;      ///< 2 or more: at most so many are kept for output, first and last included
  std::optional<cloth::Fabric> fabric;  ///< absent: cotton
  /// Its thickness_m is not used: see below; a paper proxy is met with the paper's response. Two sweeps keep
  /// cotton under 5 % of stretch at 95 %.
  cloth::SolverOptions solver = {.substeps = 16, .iterations = 2};
  std::optional<double> thickness_m;  ///< kept between particles and skin; absent: fitted_thickness_m()
};

struct DrapedGarment {
  std::string name;
  std::size_t vertices = 0, held = 0;
};

/// Penetration is measured in the skin's exact signed distance, never in the proxy.
struct DrapeReport {
  int frames = 0;
  std::size_t particles = 0;
  double frame_ms_median = 0.0, frame_ms_p99 = 0.0, frame_ms_max = 0.0;
  std::size_t penetration_over_1mm = 0;  ///< particles deeper than 1 mm at the last frame
  double penetration_max_m = 0.0;        ///< deepest of any particle in any frame
  double penetration_end_m = 0.0;        ///< deepest at the last frame
  double thickness_m = 0.0;              ///< in force
  int worst_frame = 0;
  double pierced_share = 0.0;    ///< of the cloth's area, inside the skin at the end
  std::size_t inside_union = 0;  ///< particles inside any ellipsoid (relief: the proxy) at the end
  double stretch_p95 = 0.0, stretch_max = 0.0;  ///< edge strain at the end
  double median_speed_m_s = 0.0;                ///< at the end
  bool finite = true;                           ///< in every frame
  std::uint64_t hash = 0;                       ///< of the final state: equal for any worker count
  std::vector<DrapedGarment> garments;
  std::string fabric;  ///< in force, as dt_s and substeps
  double dt_s = 0.0;
  int substeps = 0;
  std::vector<engine::StageTime> stages;  ///< drape
  std::vector<engine::Warning> warnings;
};

struct DrapeResult {
  std::vector<io::GarmentTrack> garments;
  DrapeReport report;
};

/// Drapes all garments together. Fails with kUnusableGeometry when no garment has a usable triangle, with
/// kInvalidArgument when an option is out of its range or a garment names a vertex that it does not have.
engine::Result<DrapeResult> drape(const engine::Context& context, const PreparedBody& body,
                                  const std::vector<WornGarment>& garments, const DrapeOptions& options,
                                  const Progress& progress = {});

}  // namespace bodice::tryon
