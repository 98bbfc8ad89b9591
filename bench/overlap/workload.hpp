#pragma once

#include <memory>
#include <string>

#include <bodice/engine/context.hpp>
#include <bodice/engine/function_ref.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice_bench {

/// What the frames simulate and what is prepared behind them.
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

/// Arithmetic in the shape of the real thing: a frame of 8 substeps of 3 loops over 20k particles, and
/// preprocessing of loops whose blocks take about `slice_us`, with a serial stretch in between.
std::unique_ptr<Workload> make_synthetic(double slice_us);

/// A tube of cloth of 5k particles, 8 substeps a frame, on a body proxy; and the preparation of a generated
/// body of `vertices` from its mesh to a proxy of `tier`, as a try-on session does it.
std::unique_ptr<Workload> make_body_work(int vertices, bodice::proxy::Tier tier);

}  // namespace bodice_bench
