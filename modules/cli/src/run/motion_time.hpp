// One time of a motion file, as the joints of a bound proxy.
#pragma once

#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/tryon/rigged_body.hpp>

namespace bodice::inline v0_1::cli {

/// A time of a file's clip.
struct MotionTime {
  tryon::MotionChoice choice;  ///< the name of a file
  double time_s = 0.0;
};

/// Joint space to world of each joint of the binding, #J, by the names of joints. What a skeleton's joints do
/// to its own bind pose, the proxy's joints do to theirs. Fails where the file or the clip cannot be had, or
/// a joint that moves skin is missing.
engine::Result<std::vector<proxy::JointMatrix>> joints_at(const engine::Context& context,
                                                          const proxy::Binding& binding,
                                                          const MotionTime& motion);

}  // namespace bodice::cli
