#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <bodice/colliders/convex_pieces.hpp>
#include <bodice/colliders/formats.hpp>
#include <bodice/colliders/reduce.hpp>
#include <bodice/engine/executor.hpp>
#include <bodice/engine/message.hpp>
#include <bodice/engine/write_file.hpp>
#include <bodice/io/import.hpp>
#include <bodice/proxy/base_pose.hpp>
#include <bodice/proxy/proxy_distance.hpp>
#include <bodice/proxy/proxy_surface.hpp>

#include "options/options.hpp"
#include "options/validators.hpp"
#include "output/outputs.hpp"
#include "output/terminal.hpp"

namespace bodice::inline v0_1::cli {
namespace {

/// Cells of the surface that stands for the skin where no body is given.
constexpr double kReferenceCells = 200.0;
constexpr std::string_view kConvex = "convex";

struct ExportCommand {
  std::string proxy, format, output, body, report, shapes;
  int count = 32;
  bool quiet = false;
};

/// A collider and what it costs.
struct Reduced {
  std::vector<colliders::PlainShape> shapes;   ///< empty where ellipsoids or pieces are written
  std::vector<colliders::ConvexPiece> pieces;  ///< what --to convex writes
  colliders::ReductionCost cost;
  std::string what;  ///< "32 capsules", "89 ellipsoids"
};

/// Whether the skin is the one that the proxy stands for. Wide tiers enclose theirs; much of another body's
/// is outside.
engine::Result<void> check_body(const proxy::BodyProxy& proxy, const geometry::TriMesh& skin,
                                const std::string& file) {
  constexpr std::size_t kSamples = 1000;
  // A share of the stature, 5 mm. No tier leaves out a tenth of that of its own skin.
  constexpr double kOther = 0.003;
  const std::size_t step = std::max<std::size_t>(1, skin.positions.size() / kSamples);
  double sum_m = 0.0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < skin.positions.size(); v += step, ++count)
    sum_m += std::max(0.0, proxy::proxy_distance(proxy, skin.positions[v]).distance);
  const double mean_m = sum_m / static_cast<double>(std::max<std::size_t>(1, count));
  if (mean_m <= kOther * proxy.stature_m()) return {};
  return engine::Error{engine::ErrorCode::kInvalidArgument,
                       engine::message("The body '", file, "' is not that of the proxy: its skin is ",
                                       std::lround(1e3 * mean_m), " mm outside of it on average."),
                       "Name the file that the proxy was fitted to, in the pose that it had."};
}

engine::Result<geometry::TriMesh> reference(const engine::Context& context, const ExportCommand& command,
                                            const proxy::BodyProxy& proxy) {
  if (!command.body.empty()) {
    io::ImportOptions options;
    options.up = proxy.frame().up;
    auto body = io::import_body(context, command.body, options);
    if (!body) return std::move(body).error();
    if (auto same = check_body(proxy, body->skin, command.body); !same) return same.error();
    return std::move(body->skin);
  }
  auto surface = proxy::proxy_surface(context, proxy, proxy.stature_m() / kReferenceCells);
  if (!surface) return std::move(surface).error();
  return std::move(surface->mesh);
}

engine::Result<Reduced> reduce(const engine::Context& context, const ExportCommand& command,
                               const colliders::FormatFacts& facts, const proxy::BodyProxy& proxy) {
  const auto mesh = reference(context, command, proxy);
  if (!mesh) return mesh.error();
  const colliders::SkinPoints points = colliders::skin_points(context, proxy, *mesh);
  Reduced reduced;
  if (facts.takes_ellipsoids) {
    reduced.cost = colliders::cost_of_ellipsoids(context, proxy, points);
    reduced.what = engine::message(proxy.ellipsoids().size(), " ellipsoids");
    return reduced;
  }
  if (command.format == kConvex) {
    auto pieces = colliders::convex_pieces(context, proxy, points, command.count);
    if (!pieces) return std::move(pieces).error();
    reduced.pieces = std::move(pieces).value();
    reduced.cost = colliders::cost_of_pieces(context, proxy, points, reduced.pieces);
    reduced.what = engine::message(reduced.pieces.size(), " convex pieces");
    return reduced;
  }
  const auto kind = command.shapes.empty() ? colliders::ShapeKind::kCapsule
                                           : *colliders::shape_kind_from_name(command.shapes);
  auto shapes = colliders::reduce(context, proxy, points, kind, command.count);
  if (!shapes) return std::move(shapes).error();
  reduced.shapes = std::move(shapes).value();
  reduced.cost = colliders::cost_of(context, proxy, points, reduced.shapes);
  reduced.what = engine::message(
      reduced.shapes.size(), " ",
      kind == colliders::ShapeKind::kTaperedCapsule ? "tapered capsules" : colliders::name(kind));
  return reduced;
}

void print_cost(const ExportCommand& command, const Reduced& reduced) {
  std::printf("collider    %s for %s\n", reduced.what.c_str(), command.format.c_str());
  const auto row = [](std::string_view name, const colliders::SurfaceError& error) {
    std::printf("%-11s mean %.2f mm, 95 %% within %.2f mm, worst %.2f mm\n", std::string(name).c_str(),
                1e3 * error.mean_m, 1e3 * error.p95_m, 1e3 * error.worst_m);
  };
  std::printf("error       against %s\n", command.body.empty()
                                              ? "the proxy's surface (--body measures against the skin)"
                                              : ("the skin of " + command.body).c_str());
  row("  whole", reduced.cost.whole);
  for (std::size_t p = 0; p < reduced.cost.of_part.size(); ++p)
    if (reduced.cost.of_part[p].area_m2 > 0.0)
      row("  " + std::string(body::kPartNames[p]), reduced.cost.of_part[p]);
}

engine::Result<std::string> text_of(const ExportCommand& command, const proxy::BodyProxy& proxy,
                                    const Reduced& reduced) {
  if (command.format != kConvex)
    return colliders::text_of(*colliders::format_from_name(command.format), proxy, reduced.shapes);
  return extension_of(command.output) == ".obj" ? colliders::convex_obj(proxy, reduced.pieces)
                                                : colliders::convex_gltf(proxy, reduced.pieces);
}

std::vector<std::string> extensions_of(const colliders::FormatFacts& facts) {
  std::vector<std::string> extensions{std::string(facts.extension)};
  if (!facts.other_extension.empty()) extensions.emplace_back(facts.other_extension);
  return extensions;
}

engine::Result<void> check_shapes(const ExportCommand& command, const colliders::FormatFacts& facts) {
  if (command.shapes.empty() || (!facts.takes_ellipsoids && command.format != kConvex)) return {};
  return engine::Error{engine::ErrorCode::kInvalidArgument,
                       "--shapes " + command.shapes + ": " + command.format + " takes " +
                           (facts.takes_ellipsoids ? "ellipsoids." : "convex pieces."),
                       "Leave --shapes out."};
}

/// Writes the report first, and takes it back where the colliders cannot be written: one is never there
/// without the other.
engine::Result<void> write_both(const ExportCommand& command, std::string_view text,
                                std::string_view report) {
  if (!command.report.empty())
    if (auto done = engine::write_file(command.report, report); !done) return done;
  auto done = engine::write_file(command.output, text);
  std::error_code ignored;
  if (!done && !command.report.empty()) std::filesystem::remove(command.report, ignored);
  return done;
}

engine::Result<void> export_colliders(const ExportCommand& command) {
  const colliders::Format format = *colliders::format_from_name(command.format);
  const colliders::FormatFacts& facts = colliders::facts(format);
  const FileOption outputs[] = {{"-o", command.output, extensions_of(facts)},
                                {"--report", command.report, {".json"}}};
  const FileOption inputs[] = {{"PROXY", command.proxy}, {"--body", command.body}};
  if (auto ok = check_outputs(outputs, inputs); !ok) return ok;
  if (auto ok = check_shapes(command, facts); !ok) return ok;
  const auto both = proxy::load_with_bases(command.proxy);
  if (!both) return both.error();
  if (const auto possible = colliders::text_of(format, both->proxy, {}); !possible) return possible.error();
  const auto executor = engine::make_tbb_executor(0);
  engine::Context context;
  context.executor = executor.get();
  const auto reduced = reduce(context, command, facts, both->proxy);
  if (!reduced) return reduced.error();
  const auto text = text_of(command, both->proxy, *reduced);
  if (!text) return text.error();
  const std::string report = colliders::cost_json(
      both->proxy, reduced->cost,
      {command.format, reduced->what, command.body.empty() ? "the proxy's surface" : command.body});
  if (auto done = write_both(command, *text, report); !done) return done;
  if (command.quiet) return {};
  print_cost(command, *reduced);
  std::printf("wrote       %s\n", command.output.c_str());
  if (!command.report.empty()) std::printf("wrote       %s\n", command.report.c_str());
  return {};
}

}  // namespace

void add_export_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<ExportCommand>();
  CLI::App* sub = app.add_subcommand("export", "Write colliders for a game engine or a simulator");
  std::vector<std::string> formats;
  for (int i = 0; i < colliders::kFormatCount; ++i)
    formats.emplace_back(colliders::facts(static_cast<colliders::Format>(i)).name);
  sub->add_option("PROXY", command->proxy, "a proxy that `bodice fit` wrote")->check(not_empty())->required();
  sub->add_option("--to", command->format, "what reads the file")->check(CLI::IsMember(formats))->required();
  sub->add_option("-o,--output", command->output,
                  "the file: .json for unity and unreal, .tscn for godot, .gltf for vrm, .xml for mujoco, "
                  ".sdf for sdformat, .gltf or .obj for convex")
      ->check(not_empty())
      ->required();
  sub->add_option("--shapes", command->shapes,
                  "spheres, capsules (the default), or tapered capsules (unity, unreal); not for convex")
      ->check(CLI::IsMember({"spheres", "capsules", "tapered"}));
  sub->add_option("--count", command->count, "at most so many shapes or pieces (default: 32)")
      ->check(whole(1, colliders::kMaxShapes));
  sub->add_option("--body", command->body,
                  "the body that the proxy was fitted to: shapes are then fitted to its skin and measured "
                  "against it, in place of the proxy's surface")
      ->check(not_empty());
  sub->add_option("--report", command->report, "what the collider costs, as JSON")->check(not_empty());
  sub->add_flag("-q,--quiet", command->quiet, "print errors only");
  sub->footer(
      "Shapes carry the names of the rig's joints where the proxy is bound to one; mujoco and sdformat take\n"
      "the ellipsoids themselves, and convex is closed convex meshes for anything else.\n"
      "Example: bodice export proxy.json --to unity --body body.obj -o colliders.json");
  sub->callback([command, &exit_code] {
    const auto done = export_colliders(*command);
    exit_code = done ? kExitOk : fail(done.error());
  });
}

}  // namespace bodice::cli
