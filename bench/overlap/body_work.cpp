#include <cmath>
#include <numbers>

#include <bodice/cloth/solver.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/synth/body.hpp>
#include <bodice/tryon/preparation.hpp>
#include "workload.hpp"

namespace bodice_bench {
namespace {

using namespace bodice;
using engine::Context;

/// An open tube of about 5000 particles, wide enough for the trunk, at the height of the hips.
geometry::TriMesh make_tube() {
  constexpr std::uint32_t kAround = 100, kRows = 50;
  geometry::TriMesh mesh;
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      mesh.positions.emplace_back(0.3 * std::cos(angle), 1.1 - 0.01 * row, 0.3 * std::sin(angle));
      if (row == 0) continue;
      const std::uint32_t a = row * kAround + i, b = row * kAround + (i + 1) % kAround;
      mesh.triangles.push_back({a - kAround, b - kAround, a});
      mesh.triangles.push_back({b - kAround, b, a});
    }
  }
  return mesh;
}

collision::Collider solid_body() {
  const synth::Body body = synth::make_body(Context{}, {.vertices = 8000}).value();
  fitting::FitOptions options;
  options.tier = proxy::Tier::kSolid;
  return collision::Collider(
      fitting::fit(Context{}, {body.mesh, body.part, body.stature_m}, options).value().proxy);
}

/// A made body in memory, as a host hands it over, so that no file is read while time is measured.
io::ImportedMesh body_of(int vertices) {
  return tryon::segment_builtin(Context{}, {.vertices = vertices}, {}).value().input;
}

tryon::PreparationOptions preparation_of(proxy::Tier tier) {
  tryon::PreparationOptions options;
  options.fit.tier = tier;
  return options;
}

class BodyWork final : public Workload {
 public:
  BodyWork(int vertices, proxy::Tier tier)
      : tier_(tier),
        body_(body_of(vertices)),
        collider_(solid_body()),
        solver_(cloth::Solver::make(make_tube(), {}, cloth::find_fabric("cotton").value(), {.substeps = 8})
                    .value()) {}

  std::string describe() const override {
    return "body: cloth of " + std::to_string(solver_.particles()) +
           " particles, 8 substeps; anatomy and fit of " + std::to_string(body_.skin.positions.size()) +
           " vertices, solid, then the " + std::string(proxy::name(tier_)) + " tier";
  }
  void frame(const Context& context) override { solver_.step(context, collider_, 1.0 / 60.0); }
  engine::Result<void> prepare(const Context& context, engine::FunctionRef<void()> publish) const override {
    auto preparation = tryon::Preparation::make(preparation_of(tier_),
                                                [&](const auto&, const proxy::BodyProxy&) { publish(); });
    if (!preparation) return std::move(preparation).error();
    return preparation->run(context, body_);
  }

 private:
  proxy::Tier tier_;
  io::ImportedMesh body_;
  collision::Collider collider_;
  cloth::Solver solver_;
};

}  // namespace

std::unique_ptr<Workload> make_body_work(int vertices, bodice::proxy::Tier tier) {
  return std::make_unique<BodyWork>(vertices, tier);
}

}  // namespace bodice_bench
