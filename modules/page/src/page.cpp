#include <bodice/page/page.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/engine/text.hpp>
#include <bodice/proxy/proxy_surface.hpp>

#include "pack.hpp"
#include "page_template.hpp"
#include "still.hpp"

namespace bodice::page {
namespace {

using Json = nlohmann::ordered_json;
using geometry::Vec3;

constexpr std::size_t kMostVertices = 60000;
/// Bytes of positions over time, from which base64 makes a third more.
constexpr std::size_t kMostFrameBytes = std::size_t{4} << 20;
constexpr double kSurfaceCellsAStature = 120.0;

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
    list.push_back({{"code", w.code}, {"part", w.part}, {"text", w.message + " " + w.remedy}});
  return list;
}

Json json_of(const std::vector<engine::StageTime>& stages) {
  Json list = Json::array();
  for (const engine::StageTime& s : stages) list.push_back({s.name, s.ms});
  return list;
}

void add_body(const engine::Context& context, const tryon::PreparedBody& body, const ThinMesh& thin,
              const Cube& cube, Json& data) {
  const geometry::TriMesh& mesh = body.skin.input.skin;
  const std::vector<Vec3> points = chosen(mesh.positions, thin.vertex);
  std::vector<std::uint8_t> part;
  for (const geometry::Index v : thin.vertex)
    part.push_back(static_cast<std::uint8_t>(body.skin.anatomy.part[v]));
  data["skin"] = {{"positions", packed_positions(points, cube)},
                  {"triangles", packed_triangles(thin.triangles)},
                  {"part", packed(part)},
                  {"error", packed(errors_of(context, body.fit.proxy, points))},
                  {"vertices", mesh.positions.size()}};
  data["parts"] = Json::array(), data["colors"] = Json::array();
  for (int p = 0; p < body::kPartCount; ++p) {
    const auto color = io::part_color(static_cast<body::Part>(p));
    data["parts"].push_back(body::name(static_cast<body::Part>(p)));
    data["colors"].push_back({color[0], color[1], color[2]});
  }
  data["landmarks"] = Json::array();
  for (const body::Landmark& l : body.skin.anatomy.landmarks)
    if (l.confidence > 0.0)
      data["landmarks"].push_back(
          {{"name", body::name(l.id)}, {"at", {l.position.x(), l.position.y(), l.position.z()}}});
}

void add_proxy(const engine::Context& context, const proxy::BodyProxy& proxy, const Cube& cube, Json& data) {
  std::vector<geometry::Ellipsoid> shapes;
  std::vector<std::uint8_t> part;
  for (const proxy::ProxyEllipsoid& e : proxy.ellipsoids())
    shapes.push_back(e.shape), part.push_back(static_cast<std::uint8_t>(e.part));
  data["ellipsoids"] = {{"shapes", packed_ellipsoids(shapes)}, {"part", packed(part)}};
  if (proxy.relief().empty()) return;
  const auto surface = proxy::proxy_surface(context, proxy, proxy.stature_m() / kSurfaceCellsAStature);
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
  if (!scene.proxy_frames.empty())
    for (const std::size_t f : shown)
      data["ellipsoids"]["frames"].push_back(packed_ellipsoids(scene.proxy_frames[f]));
}

void add_drape(const tryon::DrapeReport& drape, Json& data) {
  Json penetration = Json::array(), kept = Json::array();
  for (const double depth_m : drape.penetration_of_frame_m) penetration.push_back(1e3 * depth_m);
  for (const tryon::KeptFrame& f : drape.kept)
    kept.push_back({f.time_s, 1e3 * f.proxy_error.error_m.mean, 1e3 * f.penetration_max_m});
  data["drape"] = {{"penetration", penetration},        {"kept", kept},
                   {"worst", drape.worst_frame},        {"dt", drape.dt_s},
                   {"frame_ms", drape.frame_ms_median}, {"fabric", drape.fabric}};
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

}  // namespace

std::string page_html(const engine::Context& context, const tryon::PreparedBody& body,
                      const PageContent& content) {
  static const io::Scene kNothing;
  const io::Scene& scene = content.scene ? *content.scene : kNothing;
  const ThinMesh thin = thinned(body.skin.input.skin, kMostVertices);
  const std::vector<std::size_t> shown = frames_shown(scene, thin.vertex.size());
  Cube cube = cube_around(body.skin.input.skin.positions);
  for (const std::size_t f : shown) {
    for (const io::GarmentTrack& garment : scene.garments) cube = cube_around(garment.frames[f], &cube);
    if (!scene.body_frames.empty()) cube = cube_around(scene.body_frames[f], &cube);
  }
  Json data;
  data["title"] =
      body.skin.input.file.empty() ? "the built-in body" : body.skin.input.file.filename().string();
  data["tier"] = proxy::name(body.fit.proxy.tier());
  data["hash"] = engine::hex64(body.fit.proxy.hash());
  data["gap_mm"] = {1e3 * body.fit.accuracy.gap_m.mean, 1e3 * body.fit.accuracy.gap_m.p95};
  data["cube"] = {cube.low.x(), cube.low.y(), cube.low.z(), cube.size_m};
  add_body(context, body, thin, cube, data);
  add_proxy(context, body.fit.proxy, cube, data);
  add_frames(scene, shown, thin, cube, data);
  std::vector<engine::Warning> warnings = body.all_warnings();
  std::vector<engine::StageTime> stages = body.all_stages();
  if (content.drape) {
    add_drape(*content.drape, data);
    warnings.insert(warnings.end(), content.drape->warnings.begin(), content.drape->warnings.end());
    stages.insert(stages.end(), content.drape->stages.begin(), content.drape->stages.end());
  }
  data["warnings"] = json_of(warnings), data["stages"] = json_of(stages);
  data["report"] = content.report;
  std::string page(kPage);
  put(page, "<!--style-->", std::string(kStyle));
  put(page, "<!--still-->", still_svg(body.fit.proxy));
  put(page, "<!--data-->", safe_in_html(data.dump(-1, ' ', true, Json::error_handler_t::replace)));
  put(page, "<!--script-->", std::string(kScene) + std::string(kPanel));
  return page;
}

}  // namespace bodice::page
