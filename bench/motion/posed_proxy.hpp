// The proxy that moves, behind the interface of the peers.
#pragma once

#include <bodice/binding/poser.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/tryon/prepare.hpp>

#include <bench_references/moving_peers.hpp>

namespace bench {

/// Carried from the fit at rest alone, or with tables that are solved anew for each pose.
class PosedProxy final : public MovingPeer {
 public:
  PosedProxy(const bodice::tryon::PreparedBody& body, bool refit);
  /// Carried, and raised where the posed skin is outside of it.
  static PosedProxy covering(const bodice::tryon::PreparedBody& body) {
    PosedProxy made(body, false);
    made.covers_ = true;
    return made;
  }
  /// Carried, with base poses that were made beforehand.
  PosedProxy(const bodice::tryon::PreparedBody& body, const bodice::proxy::BasePoses& bases);

  std::string name() const override {
    return refit_       ? "bodice, refit in the pose"
           : has_bases_ ? "bodice, clip prepared"
           : covers_    ? "bodice, carried and covering"
                        : "bodice, carried";
  }
  bool needs_skin() const override { return covers_; }
  void pose(const MovingFrame& frame) override;
  void query(const Cloud& cloud, std::span<float> distance_m) override;
  double bytes() const override {
    return static_cast<double>(body_->fit.proxy.bytes() + body_->fit.proxy.binding()->bytes());
  }

  /// Poses without a refit, and without moving the collider.
  void pose_alone(const MovingFrame& frame, const bodice::binding::PoseOptions& options);
  bodice::collision::Collider& collider() { return collider_; }
  const bodice::binding::Poser& poser() const { return poser_; }
  const std::vector<double>& refit_ms() const { return refit_ms_; }

 private:
  const bodice::tryon::PreparedBody* body_;
  bool refit_ = false, has_bases_ = false, covers_ = false;
  bodice::binding::Poser poser_;
  bodice::collision::Collider collider_;
  std::vector<bodice::collision::Contact> contacts_;
  std::vector<double> refit_ms_;
};

}  // namespace bench
