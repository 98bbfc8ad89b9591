#include <bodice/page/page.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/json.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/engine/text.hpp>
#include <bodice/proxy/proxy_surface.hpp>

#include "pack.hpp"
#include "page_template.hpp"
#include "still.hpp"

namespace bodice::inline v0_1::page {
namespace {

using engine::Json;
using geometry::Vec3;

constexpr std::size_t kMostVertices = 60000;
/// Bytes of positions over time, from which base64 makes a third more.
constexpr std::size_t kMostFrameBytes = std::size_t{4} << 20;
constexpr double kSurfaceCellsAStature = 120.0;
constexpr double kSurfaceCellsAlone = 240.0;  // where there is no skin to look at

/// Signed distances of the skin to the proxy in hundredths of a millimeter: positive where the proxy falls
/// short.
std::vector<std::int16_t> errors_of(const engine::Context& context, const proxy::BodyProxy& proxy,
                                    std::span<const Vec3> points) {
  const collision::Collider collider(proxy);
  std::vector<std::int16_t> errors(points.size());
  engine::parallel_for(context, points.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const Eigen::Vector3f local = (points[p] - collider.origin()).cast<float>();
      const double distance_m = double{collider.query({local.x(), local.y(), local.z()}).signed_distance};
      errors[p] = static_cast<std::int16_t>(std::lround(std::clamp(1e5 * distance_m, -32767.0, 32767.0)));
    }
  });
  return errors;
}

std::vector<Vec3> chosen(std::span<const Vec3> points, std::span<const geometry::Index> vertex) {
  std::vector<Vec3> out;
  out.reserve(vertex.size());
  for (const geometry::Index v : vertex) out.push_back(points[v]);
  return out;
}

/// The kept frames that a page has: every so many, and the last.
std::vector<std::size_t> frames_shown(const io::Scene& scene, std::size_t skin_vertices) {
  if (scene.garments.empty()) return {};
  const std::size_t frames = scene.garments.front().frames.size();
  std::size_t vertices = scene.body_frames.empty() ? 0 : skin_vertices;
  for (const io::GarmentTrack& garment : scene.garments) vertices += garment.mesh.positions.size();
  const std::size_t stride =
      std::max<std::size_t>(1, (6 * vertices * frames + kMostFrameBytes - 1) / kMostFrameBytes);
  std::vector<std::size_t> shown;
  for (std::size_t f = 0; f < frames; f += stride) shown.push_back(f);
  if (!shown.empty() && shown.back() + 1 != frames) shown.push_back(frames - 1);
  return shown;
}

/// Twelve floats an ellipsoid: center, and axes times radii.
std::string packed_ellipsoids(std::span<const geometry::Ellipsoid> shapes) {
  std::vector<float> values;
  for (const geometry::Ellipsoid& e : shapes) {
    for (const double v : e.center) values.push_back(static_cast<float>(v));
    for (int k = 0; k < 3; ++k)
      for (const double v : Vec3(e.radii[k] * e.axes.col(k))) values.push_back(static_cast<float>(v));
  }
  return packed(values);
}

Json json_of(const std::vector<engine::Warning>& warnings) {
  Json list = Json::array();
  for (const engine::Warning& w : warnings)
    list.push_back({{"code", w.code},
                    {"part", w.part},
                    {"text", (w.note ? "Note: " : "") + w.message + " " + w.remedy}});
  return list;
}

Json json_of(const std::vector<engine::StageTime>& stages) {
  Json list = Json::array();
  for (const engine::StageTime& s : stages) list.push_back({s.name, s.ms});
  return list;
}

Json json_of(const std::vector<TaskSpan>& tasks) {
  Json list = Json::array();
  for (const TaskSpan& t : tasks) list.push_back({t.name, t.begin_ms, t.ms, t.thread});
  return list;
}

void add_parts(const PageSubject& subject, Json& data) {
  data["parts"] = Json::array(), data["colors"] = Json::array();
  for (int p = 0; p < body::kAllPartCount; ++p) {
    const auto color = io::part_color(static_cast<body::Part>(p));
    data["parts"].push_back(body::name(static_cast<body::Part>(p)));
    data["colors"].push_back({color[0], color[1], color[2]});
  }
  data["landmarks"] = Json::array();
  for (const NamedPoint& l : subject.landmarks)
    data["landmarks"].push_back({{"name", l.name}, {"at", {l.position.x(), l.position.y(), l.position.z()}}});
}

void add_skin(const engine::Context& context, const io::Scene& scene, const ThinMesh& thin, const Cube& cube,
              Json& data) {
  if (!scene.body) return;
  const std::vector<Vec3> points = chosen(scene.body->positions, thin.vertex);
  data["skin"] = {{"positions", packed_positions(points, cube)},
                  {"triangles", packed_triangles(thin.triangles)},
                  {"vertices", scene.body->positions.size()}};
  if (!scene.part.empty()) {
    std::vector<std::uint8_t> part;
    for (const geometry::Index v : thin.vertex) part.push_back(static_cast<std::uint8_t>(scene.part[v]));
    data["skin"]["part"] = packed(part);
  }
  if (scene.proxy) data["skin"]["error"] = packed(errors_of(context, *scene.proxy, points));
}

void add_ellipsoids(std::span<const proxy::ProxyEllipsoid> ellipsoids, Json& data) {
  if (ellipsoids.empty()) return;
  std::vector<geometry::Ellipsoid> shapes;
  std::vector<std::uint8_t> part;
  for (const proxy::ProxyEllipsoid& e : ellipsoids)
    shapes.push_back(e.shape), part.push_back(static_cast<std::uint8_t>(e.part));
  data["ellipsoids"] = {{"shapes", packed_ellipsoids(shapes)}, {"part", packed(part)}};
}

/// The surface shows what ellipsoids do not: the relief, and without a skin the whole.
void add_surface(const engine::Context& context, const io::Scene& scene, const Cube& cube, Json& data) {
  if (!scene.proxy || (scene.proxy->relief().empty() && scene.body)) return;
  const double cells = scene.body ? kSurfaceCellsAStature : kSurfaceCellsAlone;
  const auto surface = proxy::proxy_surface(context, *scene.proxy, scene.proxy->stature_m() / cells);
  if (surface && !surface->mesh.empty())
    data["surface"] = {{"positions", packed_positions(surface->mesh.positions, cube)},
                       {"triangles", packed_triangles(surface->mesh.triangles)}};
}

void add_frames(const io::Scene& scene, const std::vector<std::size_t>& shown, const ThinMesh& thin,
                const Cube& cube, Json& data) {
  if (shown.empty()) return;
  data["times"] = Json::array();
  for (const std::size_t f : shown) data["times"].push_back(scene.garments.front().time_s[f]);
  data["left_out"] = scene.garments.front().frames.size() - shown.size();
  for (const io::GarmentTrack& garment : scene.garments) {
    Json cloth = {{"name", garment.name}, {"triangles", packed_triangles(garment.mesh.triangles)}};
    for (const std::size_t f : shown) cloth["frames"].push_back(packed_positions(garment.frames[f], cube));
    if (!garment.colors.empty()) cloth["colors"] = packed_colors(garment.colors);
    data["cloth"].push_back(std::move(cloth));
  }
  if (!scene.body_frames.empty())
    for (const std::size_t f : shown)
      data["skin"]["frames"].push_back(packed_positions(chosen(scene.body_frames[f], thin.vertex), cube));
  if (!scene.proxy_frames.empty() && data.contains("ellipsoids"))
    for (const std::size_t f : shown)
      data["ellipsoids"]["frames"].push_back(packed_ellipsoids(scene.proxy_frames[f]));
}

void add_drape(const DrapeCurves& drape, Json& data) {
  Json kept = Json::array();
  for (const KeptError& f : drape.kept) kept.push_back({f.time_s, f.proxy_error_mm, f.penetration_mm});
  data["drape"] = {{"penetration", drape.penetration_mm},
                   {"kept", kept},
                   {"worst", drape.worst_frame},
                   {"dt", drape.dt_s}};
}

/// A cube around all that moves, and all that does not.
Cube cube_of(const io::Scene& scene, std::span<const proxy::ProxyEllipsoid> ellipsoids,
             const std::vector<std::size_t>& shown) {
  std::vector<Vec3> still;
  if (scene.body) still = scene.body->positions;
  for (const proxy::ProxyEllipsoid& e : ellipsoids) {
    const geometry::Box box = geometry::bounding_box(e.shape);
    still.push_back(box.low), still.push_back(box.high);
  }
  if (still.empty() && !scene.garments.empty()) still = scene.garments.front().mesh.positions;
  Cube cube = cube_around(still);
  for (const std::size_t f : shown) {
    for (const io::GarmentTrack& garment : scene.garments) cube = cube_around(garment.frames[f], &cube);
    if (!scene.body_frames.empty()) cube = cube_around(scene.body_frames[f], &cube);
  }
  return cube;
}

/// Replaces a mark of the template, which stands in it once.
void put(std::string& page, std::string_view mark, const std::string& text) {
  page.replace(page.find(mark), mark.size(), text);
}

/// A `<` would end the element that holds the data.
std::string safe_in_html(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

Json data_of(const engine::Context& context, const PageSubject& subject, const io::Scene& scene,
             std::span<const proxy::ProxyEllipsoid> ellipsoids) {
  const ThinMesh thin = scene.body ? thinned(*scene.body, kMostVertices) : ThinMesh{};
  const std::vector<std::size_t> shown = frames_shown(scene, thin.vertex.size());
  const Cube cube = cube_of(scene, ellipsoids, shown);
  Json data = {{"title", subject.title}, {"tier", subject.tier}, {"hash", subject.hash}};
  if (subject.gap_mean_mm && subject.gap_p95_mm) data["gap_mm"] = {*subject.gap_mean_mm, *subject.gap_p95_mm};
  data["cube"] = {cube.low.x(), cube.low.y(), cube.low.z(), cube.size_m};
  add_parts(subject, data);
  add_skin(context, scene, thin, cube, data);
  add_ellipsoids(ellipsoids, data);
  add_surface(context, scene, cube, data);
  add_frames(scene, shown, thin, cube, data);
  if (subject.drape) add_drape(*subject.drape, data);
  data["warnings"] = json_of(subject.warnings), data["stages"] = json_of(subject.stages);
  data["tasks"] = json_of(subject.tasks);
  data["lacks"] = subject.lacks;
  data["report"] = subject.report;
  return data;
}

}  // namespace

std::string page_html(const engine::Context& context, const PageSubject& subject) {
  static const io::Scene kNothing;
  const io::Scene& scene = subject.scene ? *subject.scene : kNothing;
  const auto ellipsoids = scene.proxy ? scene.proxy->ellipsoids() : subject.ellipsoids;
  const Json data = data_of(context, subject, scene, ellipsoids);
  std::string page(kPage);
  put(page, "<!--style-->", std::string(kStyle));
  put(page, "<!--still-->", still_svg(ellipsoids));
  put(page, "<!--data-->", safe_in_html(data.dump({.ascii = true, .replaces_invalid = true})));
  put(page, "<!--script-->", std::string(kScene) + std::string(kPanel));
  return page;
}

}  // namespace bodice::page
