#pragma once

#include <memory>
#include <string>

#include <bodice/engine/context.hpp>
#include <bodice/engine/function_ref.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice_bench {

/// The work of a frame, and the work of preparing a body behind the frames.
class Workload {
 public:
  virtual ~Workload() = default;
  virtual std::string describe() const = 0;
  /// One simulation frame.
  virtual void frame(const bodice::engine::Context& context) = 0;
  /// The preprocessing of one body; calls `publish` with each result, coarse ones first.
  virtual bodice::engine::Result<void> prepare(const bodice::engine::Context& context,
                                               bodice::engine::FunctionRef<void()> publish) const = 0;
};

/// Arithmetic in the pattern of real work: a frame is 8 substeps of 3 loops over 20k particles, and
/// preprocessing alternates loops, with blocks of about `slice_us`, and serial work.
std::unique_ptr<Workload> make_synthetic(double slice_us);

/// Real work: a frame steps a tube of cloth of 5k particles on a body proxy, 8 substeps, and preprocessing
/// takes a made body of `vertices` from its mesh to a proxy of `tier`, as a try-on session does.
std::unique_ptr<Workload> make_body_work(int vertices, bodice::proxy::Tier tier);

}  // namespace bodice_bench
