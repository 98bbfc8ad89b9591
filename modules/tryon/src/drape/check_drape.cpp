#include "drape/check_drape.hpp"

#include <cmath>
#include <string>
#include <utility>

#include <bodice/engine/message.hpp>

namespace bodice::inline v0_1::tryon {

namespace {

constexpr double kMostRamp_s = 60.0;
// A garment is the skin itself if all but few of its vertices are this near to the skin, and it has most of
// the skin's area.
constexpr double kOnSkin_m = 1e-4, kMostBeside = 0.01, kLeastOfSkin = 0.9;

bool is_the_skin(const geometry::TriMesh& garment, const SegmentedSkin& skin) {
  if (surface_area(garment) < kLeastOfSkin * surface_area(skin.input.skin)) return false;
  const std::size_t most =
      static_cast<std::size_t>(kMostBeside * static_cast<double>(garment.positions.size()));
  std::size_t off = 0;
  for (const geometry::Vec3& p : garment.positions) {
    const bool near = p.allFinite() && (skin.distance->closest_point(p).point - p).norm() < kOnSkin_m;
    if (!near && ++off > most) return false;
  }
  return !garment.positions.empty();
}

}  // namespace

engine::Result<void> check(const DrapeOptions& options, const PreparedBody& body) {
  const auto bad = [](std::string what, std::string remedy) {
    return engine::Error{engine::ErrorCode::kInvalidArgument, "Drape option " + what + ".",
                         std::move(remedy)};
  };
  if (options.frames < 1) return bad(engine::message("frames is ", options.frames), "Give 1 or more.");
  if (options.kept_frames < 2)
    return bad(engine::message("kept_frames is ", options.kept_frames), "Give 2 or more.");
  if (!(options.dt_s >= 0.0 && std::isfinite(options.dt_s)))
    return bad(engine::message("dt_s is ", options.dt_s), "Give seconds, zero or more.");
  if (!(options.tack_m >= 0.0 && std::isfinite(options.tack_m)))
    return bad(engine::message("tack_m is ", options.tack_m), "Give meters, zero or more.");
  if (options.ramp_s && !(*options.ramp_s >= 0.0 && *options.ramp_s <= kMostRamp_s))
    return bad(engine::message("ramp_s is ", *options.ramp_s), "Give seconds, 0 to 60.");
  if (options.motion) return check(*options.motion, body.skin.input.skin.positions.size());
  return {};
}

engine::Result<void> check(const std::vector<WornGarment>& garments, const PreparedBody& body) {
  for (const WornGarment& garment : garments) {
    if (is_the_skin(garment.mesh, body.skin))
      return engine::Error{engine::ErrorCode::kInvalidArgument,
                           garment.name + ": this garment is the skin of the body itself.",
                           "Name the garment's own file or mesh."};
  }
  return {};
}

}  // namespace bodice::tryon
