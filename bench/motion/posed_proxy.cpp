#include "posed_proxy.hpp"

#include <bodice/tryon/base_pose.hpp>

#include <bench_support/or_exit.hpp>
#include <bench_support/stopwatch.hpp>

namespace bench {

using namespace bodice;

PosedProxy::PosedProxy(const tryon::PreparedBody& body, bool refit)
    : body_(&body),
      refit_(refit),
      poser_(or_exit(binding::Poser::make(body.fit.proxy))),
      collider_(body.fit.proxy) {}

PosedProxy::PosedProxy(const tryon::PreparedBody& body, const proxy::BasePoses& bases)
    : PosedProxy(body, false) {
  has_bases_ = true;
  for (const auto& base : bases) or_exit(poser_.keep_base(base));
}

void PosedProxy::pose(const MovingFrame& frame) {
  if (refit_) {
    const Stopwatch watch;
    const auto base =
        or_exit(tryon::make_base_pose({}, body_->fit.proxy, body_->skin, frame.joints, "in the frame"));
    refit_ms_.push_back(watch.cpu_ms());
    poser_ = or_exit(binding::Poser::make(body_->fit.proxy));
    or_exit(poser_.keep_base(base));
  }
  pose_alone(frame, {});
  if (collider_.pose(poser_.posed(), 0.0)) {
    if (covers_) collider_.cover({}, frame.skin.positions);
    return;
  }
  std::fprintf(stderr, "The collider refuses a pose.\n");
  std::exit(1);
}

void PosedProxy::pose_alone(const MovingFrame& frame, const binding::PoseOptions& options) {
  or_exit(poser_.pose({}, frame.joints, options));
}

void PosedProxy::query(const Cloud& cloud, std::span<float> distance_m) {
  Cloud particles = local(cloud, collider_);
  contacts_.resize(cloud.size());
  collider_.query({}, particles.particles(), contacts_);
  for (std::size_t i = 0; i < contacts_.size(); ++i) distance_m[i] = contacts_[i].signed_distance;
}

}  // namespace bench
