#include "drape/check_drape.hpp"

#include <cmath>
#include <string>
#include <utility>

#include <bodice/engine/message.hpp>

namespace bodice::inline v0_1::tryon {

namespace {
constexpr double kMostRamp_s = 60.0;
}

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

}  // namespace bodice::tryon
