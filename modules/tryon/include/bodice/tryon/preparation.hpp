// A body's way from its file to its proxy, as a graph of tasks: each starts as soon as what it needs is
// there, and what is ready is handed on.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <bodice/engine/task_graph.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::tryon {

struct BodyFile {
  std::filesystem::path file;
};
using BodySource = std::variant<BodyFile, synth::BodyOptions, io::ImportedMesh>;

struct PreparationOptions {
  SegmentOptions segment;
  fitting::FitOptions fit;  ///< its on_improved and on_part are the preparation's
  /// With garments, only the parts within region_margin_m of them are fitted; the others cost nothing.
  std::vector<geometry::TriMesh> garments;
  double region_margin_m = 0.05;
};

/// Given each proxy of a body, coarse to fine, one call at a time and in the same order in every run: one
/// enclosing ellipsoid a part, then solid parts as each is ready, then what FitOptions asks for. The skin is
/// the same one each time.
using OnProxy = std::function<void(const std::shared_ptr<const SegmentedSkin>&, const proxy::BodyProxy&)>;

/// Built once, run for one body after another.
///
///     body -> anatomy --------> skin -> region -> coarse proxy -> solid parts -> proxy
///         `-> distance field --^
class Preparation {
 public:
  static engine::Result<Preparation> make(PreparationOptions options, OnProxy on_proxy);

  /// Fails as the task does that failed first; what was handed on before stays valid.
  engine::Result<void> run(const engine::Context& context, BodySource body);

  /// Of the last run, if it came so far.
  const fitting::FitResult* fit() const { return graph_.find(proxy_); }

  /// The tasks and what they hand on, in the DOT language.
  std::string dump_dot() const { return graph_.dump_dot(); }

 private:
  Preparation(engine::TaskGraph graph, engine::Output<BodySource> source,
              engine::Output<fitting::FitResult> proxy)
      : graph_(std::move(graph)), source_(std::move(source)), proxy_(std::move(proxy)) {}

  engine::TaskGraph graph_;
  engine::Output<BodySource> source_;
  engine::Output<fitting::FitResult> proxy_;
};

}  // namespace bodice::tryon
