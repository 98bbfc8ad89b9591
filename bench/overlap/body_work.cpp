#include <cmath>
#include <numbers>

#include <bodice/cloth/solver.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/synth/body.hpp>
#include "workload.hpp"

namespace bodice_bench {
namespace {

using namespace bodice;
using engine::Context;

// An open tube of about 5000 particles, wide enough for the trunk, at the height of the hips.
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

proxy::BodyProxy fit_paper(const Context& context, const synth::Body& body) {
  fitting::FitOptions options;
  options.tier = proxy::Tier::kPaper;
  return fitting::fit(context, {body.mesh, body.part, body.stature_m}, options).value().proxy;
}

synth::Body body_of(int vertices) {
  return synth::make_body(Context{}, {.vertices = vertices}).value();
}

class BodyWork final : public Workload {
 public:
  explicit BodyWork(int vertices)
      : body_(body_of(vertices)),
        collider_(fit_paper(Context{}, body_of(8000))),
        solver_(cloth::Solver::make(make_tube(), {}, cloth::find_fabric("cotton").value(), {.substeps = 8})
                    .value()) {}

  std::string describe() const override {
    return "body: cloth of " + std::to_string(solver_.particles()) + " particles, 8 substeps; fit of " +
           std::to_string(body_.mesh.positions.size()) + " vertices at the paper tier";
  }
  void frame(const Context& context) override { solver_.step(context, collider_, 1.0 / 60.0); }
  engine::Result<void> prepare(const Context& context, engine::FunctionRef<void()> publish) const override {
    fitting::FitOptions options;
    options.tier = proxy::Tier::kPaper;
    const auto result = fitting::fit(context, {body_.mesh, body_.part, body_.stature_m}, options);
    if (!result) return result.error();
    publish();
    return {};
  }

 private:
  synth::Body body_;
  collision::Collider collider_;
  cloth::Solver solver_;
};

}  // namespace

std::unique_ptr<Workload> make_body_work(int vertices) {
  return std::make_unique<BodyWork>(vertices);
}

}  // namespace bodice_bench
