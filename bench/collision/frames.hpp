// The same particles call after call, as a solver queries them.
#pragma once

#include <cstdlib>

#include <bench_references/subject.hpp>

namespace bench {

/// Particles that move as a solver's do. All drift by a millimeter a call, 30 mm to and fro, and each
/// trembles. A garment that slides over a body at 60 mm a second does so at 60 calls a second.
class Frames {
 public:
  explicit Frames(const Cloud& start) : start_(start), now_(start) {}

  void step() {
    constexpr int kHalf = 60;
    constexpr float kStep_m = 1e-3f, kTremble_m = 1e-4f;
    const int phase = ++frame_ % (2 * kHalf);
    const float path_m = kStep_m * static_cast<float>(std::abs(phase - kHalf) - kHalf / 2);
    const float side_m = frame_ % 2 == 0 ? kTremble_m : -kTremble_m;
    for (std::size_t i = 0; i < start_.size(); ++i) {
      now_.x[i] = start_.x[i] + 0.7f * path_m + side_m * static_cast<float>(i * 7919 % 3);
      now_.y[i] = start_.y[i] + 0.5f * path_m + side_m * static_cast<float>(i * 104729 % 3);
      now_.z[i] = start_.z[i] + 0.5f * path_m;
    }
  }
  Cloud& now() { return now_; }
  bodice::collision::Workspace workspace;

 private:
  Cloud start_, now_;
  int frame_ = 0;
};

}  // namespace bench
