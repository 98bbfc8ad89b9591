// The preparation of a body from its file to its proxy, as a graph of tasks. Each task starts as soon as its
// inputs are there, and better and better proxies are published.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <bodice/engine/task_graph.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// A body to read from a file.
struct BodyFile {
  std::filesystem::path file;
};
/// The source of a body: a file, the built-in body, or a mesh in memory.
using BodySource = std::variant<BodyFile, synth::BodyOptions, io::ImportedMesh>;

/// How a body is segmented and fitted.
struct PreparationOptions {
  SegmentOptions segment;
  fitting::FitOptions fit;  ///< on_improved and on_part are replaced
  /// Garments that limit the fit: only parts within region_margin_m of them are fitted. Empty: all parts are.
  std::vector<geometry::TriMesh> garments;
  double region_margin_m = 0.05;
  /// Whether the body will move. The skin then gets a rig (give_rig()), ellipsoids are found on the flexed
  /// skin, and proxies are bound to the rig. Fewer proxies are published, because each binding takes a tenth
  /// of a second.
  bool bind = false;
};

/// Called with each proxy of a body, coarse to fine, one call at a time and in the same order in every run:
/// one enclosing ellipsoid a part, then solid parts one by one, then those of FitOptions. The skin is the
/// same for all of them.
using OnProxy = std::function<void(const std::shared_ptr<const SegmentedSkin>&, const proxy::BodyProxy&)>;

/// The tasks of a preparation: built once, run for one body after another.
///
///     body -> anatomy --------> skin -> region -> coarse proxy -> solid parts -> proxy
///         `-> distance field --^
class Preparation {
 public:
  /// Builds the tasks; none runs yet. `on_proxy` is called in run(), and may be empty. Fails where tasks do
  /// not fit together, which is a bug.
  static engine::Result<Preparation> make(PreparationOptions options, OnProxy on_proxy);

  /// Prepares a body. Fails with the error of the first failed task; proxies published before stay valid.
  engine::Result<void> run(const engine::Context& context, BodySource body);

  /// The result of the last run, or null if it did not reach it.
  const fitting::FitResult* fit() const { return graph_.find(proxy_); }

  /// The tasks and their data flow in the DOT language.
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
