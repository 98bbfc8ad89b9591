#include "motion/refits.hpp"

#include <algorithm>
#include <utility>

#include <bodice/tryon/base_pose.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

/// The approximate time of a refit behind frames. The refit of a moving body is for the pose that it will
/// have after this time.
constexpr double kAhead_s = 0.3;
/// A moving body gets another base pose if its joints are turned farther than this from every one that it
/// has.
constexpr double kFarMoving_rad = 0.35;
/// A body that stands still gets a base pose in its very pose if its joints are turned farther than this.
constexpr double kFarStill_rad = 0.08;
/// A joint stands still if every entry of its matrix changes by less than this within kAhead_s.
constexpr double kStill = 0.02;
/// Number of poses over which the share of a new base pose rises to one.
constexpr int kPosesToBlend = 10;

bool stand_still(std::span<const rig::Affine> now, std::span<const rig::Affine> later) {
  double most = 0.0;
  for (std::size_t j = 0; j < now.size(); ++j)
    most = std::max(most, (now[j] - later[j]).leftCols<3>().cwiseAbs().maxCoeff());
  return most < kStill;
}

}  // namespace

bool Refits::take(const proxy::BodyProxy& proxy, MovingBody& body) {
  const Refit* const ready = stream_.current();
  if (ready == taken_) return false;
  taken_ = ready;
  runs_ = false;
  if (!ready || !ready->base || ready->proxy_hash != proxy.hash()) return false;
  return body.poser()->add_base(ready->base, kPosesToBlend).ok();
}

void Refits::begin_if_needed(const std::shared_ptr<const SegmentedSkin>& skin, const proxy::BodyProxy& proxy,
                             MovingBody& body, ClipPlayback& playback, bool paused) {
  if (runs_ || proxy.relief().empty()) return;
  ahead_.resize(playback.joints().size());
  if (paused)
    std::ranges::copy(playback.joints(), ahead_.begin());
  else
    playback.joints_ahead(kAhead_s, ahead_);
  const bool still = stand_still(playback.joints(), ahead_);
  if (body.poser()->departure_rad(ahead_) < (still ? kFarStill_rad : kFarMoving_rad)) return;
  runs_ = true;
  stream_.submit("refit",
                 [skin, proxy, joints = ahead_](const engine::Context& context,
                                                engine::Sink<Refit>& sink) -> engine::Result<void> {
                   auto base = make_base_pose(context, proxy, *skin, joints, "");
                   if (!base && base.error().code == engine::ErrorCode::kCanceled)
                     return std::move(base).error();
                   sink.publish(std::make_shared<const Refit>(Refit{proxy.hash(), base ? *base : nullptr}));
                   return {};
                 });
}

}  // namespace bodice::tryon
