#include <bodice/tryon/prop.hpp>

#include <algorithm>
#include <utility>

#include <bodice/engine/message.hpp>
#include <bodice/proxy/add_things.hpp>
#include <bodice/tryon/penetration.hpp>

#include "measure/prop_start.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

/// The largest depth of a garment in a prop at the start, where it may touch it.
constexpr double kTouches_m = 0.005;

/// The options of a prop's fit, from those of the body's fit. Boards need a tier that is fitted to the
/// surface, because an ellipsoid that encloses a seat rises centimeters above it.
fitting::FitOptions prop_options(const PreparedBody& body, const fitting::FitOptions& of_body) {
  fitting::FitOptions options;
  options.tier = body.fit.proxy.relief().empty() ? proxy::Tier::kTight : proxy::Tier::kRelief;
  options.target_error_m = of_body.target_error_m;
  options.max_ellipsoids = of_body.max_ellipsoids;
  options.time_budget_s = of_body.time_budget_s;
  // The time of a query depends on the ellipsoids nearby, not on the number of all, so that a time budget
  // gives none.
  if (of_body.budget_us) options.max_ellipsoids = static_cast<int>(body.fit.proxy.ellipsoids().size());
  return options;
}

engine::Result<PreparedBody> fit_beside(const engine::Context& context, SegmentedSkin skin,
                                        const PreparedBody& body, const fitting::FitOptions& options,
                                        const Progress& progress) {
  skin.rig.reset();
  // All tables of a proxy have the same reach, which is proportional to the stature.
  skin.anatomy.stature_m = body.fit.proxy.stature_m();
  return fit_proxy(context, std::move(skin), prop_options(body, options), progress);
}

}  // namespace

engine::Result<PreparedBody> read_prop(const engine::Context& context, const std::filesystem::path& file,
                                       const PreparedBody& body, const fitting::FitOptions& options,
                                       const Progress& progress) {
  SegmentOptions segment;
  segment.import.shape = io::Shape::kAny;
  segment.import.frame = body.skin.input.frame;
  auto skin = segment_file(context, file, segment, progress);
  if (!skin) return std::move(skin).error();
  return fit_beside(context, std::move(skin).value(), body, options, progress);
}

engine::Result<PreparedBody> make_prop(const engine::Context& context, const geometry::TriMesh& mesh,
                                       const PreparedBody& body, const fitting::FitOptions& options) {
  auto input = repair_body(context, mesh);
  if (!input) return std::move(input).error();
  input->shape = io::Shape::kAny;
  auto skin = segment_mesh(context, std::move(input).value(), {});
  if (!skin) return std::move(skin).error();
  return fit_beside(context, std::move(skin).value(), body, options, {});
}

engine::Result<proxy::BodyProxy> with_props(const proxy::BodyProxy& body,
                                            std::span<const PreparedBody> props) {
  std::vector<proxy::BodyProxy> things;
  for (const PreparedBody& prop : props) things.push_back(prop.fit.proxy);
  return proxy::add_things(body, things);
}

std::vector<PropReport> describe(std::span<const PreparedBody> props) {
  std::vector<PropReport> reports;
  for (const PreparedBody& prop : props)
    reports.push_back({.name = prop.skin.input.file.string(),
                       .ellipsoids = prop.fit.proxy.ellipsoids().size(),
                       .accuracy = prop.fit.accuracy});
  return reports;
}

engine::Result<void> check_start(const engine::Context& context, std::span<const geometry::Vec3> positions,
                                 std::span<const PreparedBody> props) {
  for (const PreparedBody& prop : props) {
    const double deepest_m = penetration(context, *prop.skin.distance, positions).deepest_m;
    if (deepest_m > kTouches_m)
      return engine::Error{
          engine::ErrorCode::kUnusableGeometry,
          engine::message("A garment begins up to ", 1e3 * deepest_m, " mm inside the prop ",
                          prop.skin.input.file.empty() ? "that was given" : prop.skin.input.file.string(),
                          "."),
          "Begin with a body beside the prop that moves onto it (program: --motion), or move the prop."};
  }
  return {};
}

engine::Result<void> join_props(const engine::Context& context, std::span<const geometry::Vec3> positions,
                                const PreparedBody& body, std::span<const PreparedBody> props,
                                DrapeResult& result) {
  if (props.empty()) return {};
  if (auto clear = check_start(context, positions, props); !clear) return clear;
  auto joined = with_props(body.fit.proxy, props);
  if (!joined) return std::move(joined).error();
  result.proxy = std::move(joined).value();
  result.report.props = describe(props);
  return {};
}

void add_frame(const engine::Context& context, int frame, std::span<const geometry::Vec3> positions,
               std::span<const PreparedBody> props, std::vector<PropReport>& reports) {
  for (std::size_t i = 0; i < props.size(); ++i) {
    const Penetration depth = penetration(context, *props[i].skin.distance, positions);
    PropReport& report = reports[i];
    if (depth.deepest_m > report.deepest_m) report.deepest_m = depth.deepest_m, report.worst_frame = frame;
    report.end_m = depth.deepest_m;
    report.over_1mm = depth.over_1mm;
  }
}

void add_cloth(const engine::Context& context, std::span<const geometry::Vec3> positions,
               std::span<const geometry::Triangle> triangles, std::span<const PreparedBody> props,
               std::vector<PropReport>& reports) {
  for (std::size_t i = 0; i < props.size(); ++i)
    reports[i].pierced_share = pierced_share(context, *props[i].skin.distance, positions, triangles);
}

}  // namespace bodice::tryon
