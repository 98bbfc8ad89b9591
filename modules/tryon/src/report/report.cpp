#include <bodice/tryon/report.hpp>

#include <bodice/engine/json.hpp>
#include <bodice/engine/text.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using engine::Json;

double mm(double meters) {
  return meters * 1e3;
}

std::string_view axis_name(geometry::Axis axis) {
  constexpr std::string_view kNames[] = {"x", "y", "z"};
  return kNames[static_cast<int>(axis)];
}

Json all_mm(std::span<const double> meters) {
  Json list = Json::array();
  for (const double m : meters) list.push_back(mm(m));
  return list;
}

Json spread_mm(const fitting::Spread& s) {
  return {{"mean", mm(s.mean)}, {"p95", mm(s.p95)}, {"max", mm(s.max)}};
}

/// The share of the skin's area that closes holes of the file.
double made_up_percent(const io::ImportedMesh& input) {
  if (input.made_up.empty()) return 0.0;
  double all = 0.0, made_up = 0.0;
  for (std::size_t t = 0; t < input.skin.triangles.size(); ++t) {
    const double area = area_vector(input.skin, t).norm();
    all += area;
    for (const geometry::Index v : input.skin.triangles[t]) made_up += input.made_up[v] ? area / 3.0 : 0.0;
  }
  return all > 0.0 ? 100.0 * made_up / all : 0.0;
}

Json input_json(const io::ImportedMesh& input) {
  return {{"file", input.file.string()},
          {"mesh", input.mesh},
          {"vertices", input.skin.positions.size()},
          {"triangles", input.skin.triangles.size()},
          {"unit", input.unit},
          {"up", axis_name(input.frame.up)},
          {"welded", input.repair.welded},
          {"dropped", input.repair.dropped_vertices},
          {"dropped_triangles", input.repair.dropped_triangles},
          {"components", input.repair.components},
          {"boundary_edges", input.repair.boundary_edges},
          {"made_up_percent", made_up_percent(input)},
          {"noise_mm", mm(input.noise_m)},
          {"smoothed", input.smoothed}};
}

bool is_thing(const SegmentedSkin& skin) {
  return skin.input.shape == io::Shape::kAny;
}

Json vector_json(const geometry::Vec3& v) {
  return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0};
}

/// Adds center and size of a part's box, in the file's units and axes.
void add_box(const SegmentedSkin& skin, body::Part part, Json& line) {
  geometry::Box box;
  for (std::size_t v = 0; v < skin.anatomy.part.size(); ++v)
    if (skin.anatomy.part[v] == part) box.extend(skin.input.frame.to_file(skin.input.skin.positions[v]));
  line["center"] = vector_json(box.center());
  line["size"] = vector_json(box.size());
}

/// The stature of a person, or the height of a thing's box.
double height_m(const SegmentedSkin& skin) {
  return is_thing(skin) ? geometry::bounding_box(skin.input.skin.positions).size().y()
                        : skin.anatomy.stature_m;
}

Json parts_json(const PreparedBody& body) {
  Json parts = Json::array();
  for (const fitting::PartFit& part : body.fit.parts) {
    Json line = {
        {"name", body::name(part.part)}, {"vertices", part.vertices}, {"ellipsoids", part.ellipsoids}};
    if (const auto& e = part.cluster_error)
      line["cluster_error_mm"] = {{"mean", mm(e->mean_m)}, {"max", mm(e->max_m)}};
    line["radial_error_mm"] = {{"mean", mm(part.radial_error_mean_m)}, {"max", mm(part.radial_error_max_m)}};
    line["gap_mm"] = spread_mm(part.gap_m);
    if (is_thing(body.skin)) add_box(body.skin, part.part, line);
    parts.push_back(std::move(line));
  }
  return parts;
}

Json landmarks_json(const SegmentedSkin& skin) {
  Json landmarks = Json::array();
  if (is_thing(skin)) return landmarks;
  for (const body::Landmark& landmark : skin.anatomy.landmarks) {
    const geometry::Vec3 p = skin.input.frame.to_file(landmark.position);
    landmarks.push_back({{"name", body::name(landmark.id)},
                         {"position", {p.x(), p.y(), p.z()}},
                         {"confidence", landmark.confidence}});
  }
  return landmarks;
}

Json accuracy_json(const fitting::FitAccuracy& accuracy) {
  return {{"gap_mm", spread_mm(accuracy.gap_m)},
          {"interior_covered_percent", accuracy.interior_covered_percent},
          {"skin_outside_percent", accuracy.skin_outside_percent},
          {"skin_outside_depth_mm", mm(accuracy.skin_outside_depth_m)}};
}

void append_warnings(Json& list, std::span<const engine::Warning> warnings) {
  for (const engine::Warning& w : warnings)
    list.push_back(
        {{"code", w.code}, {"part", w.part}, {"message", w.message}, {"remedy", w.remedy}, {"note", w.note}});
}

void append_stages(Json& list, std::span<const engine::StageTime> stages) {
  for (const engine::StageTime& stage : stages) list.push_back({{"name", stage.name}, {"ms", stage.ms}});
}

Json ease_json(std::span<const PartEase> parts) {
  Json list = Json::array();
  for (const PartEase& p : parts)
    list.push_back({{"part", body::name(p.part)},
                    {"area_cm2", 1e4 * p.area_m2},
                    {"girth_mm", mm(p.girth_m)},
                    {"gap_mm", {{"median", mm(p.gap_median_m)}, {"p95", mm(p.gap_p95_m)}}},
                    {"strain_percent", {{"mean", 100.0 * p.strain_mean}, {"p95", 100.0 * p.strain_p95}}}});
  return list;
}

Json tacked_json(std::span<const TackedPiece> pieces) {
  Json list = Json::array();
  for (const TackedPiece& p : pieces)
    list.push_back({{"piece", p.piece}, {"onto", p.onto}, {"points", p.points}});
  return list;
}

Json garments_json(std::span<const DrapedGarment> garments) {
  Json list = Json::array();
  for (const DrapedGarment& g : garments)
    list.push_back({{"name", g.name},
                    {"vertices", g.vertices},
                    {"held", g.held},
                    {"tacked", tacked_json(g.tacked)},
                    {"ease", ease_json(g.ease)}});
  return list;
}

Json fit_map_json(const FitScale& scale) {
  if (scale.map == FitMap::kEase)
    return {{"of", "ease"}, {"blue_mm", mm(scale.loose)}, {"red_mm", mm(scale.tight)}};
  return {{"of", "strain"}, {"blue_percent", 1e2 * scale.loose}, {"red_percent", 1e2 * scale.tight}};
}

Json kept_json(std::span<const KeptFrame> frames) {
  Json list = Json::array();
  for (const KeptFrame& f : frames)
    list.push_back({{"time_s", f.time_s},
                    {"proxy_error_mm", spread_mm(f.proxy_error.error_m)},
                    {"missed_percent", 100.0 * f.proxy_error.missed_share},
                    {"false_percent", 100.0 * f.proxy_error.false_share},
                    {"penetration",
                     {{"max_mm", mm(f.penetration_max_m)},
                      {"over_half_mm_cm2", 1e4 * f.inside.shown_m2},
                      {"overlapped_cm2", 1e4 * f.inside.overlapped_m2}}}});
  return list;
}

Json props_json(std::span<const PropReport> props) {
  Json list = Json::array();
  for (const PropReport& p : props)
    list.push_back({{"name", p.name},
                    {"ellipsoids", p.ellipsoids},
                    {"gap_mm", spread_mm(p.accuracy.gap_m)},
                    {"penetration",
                     {{"count_over_1mm", p.over_1mm},
                      {"max_mm", mm(p.deepest_m)},
                      {"end_mm", mm(p.end_m)},
                      {"worst_frame", p.worst_frame},
                      {"pierced_area_percent", p.pierced_share * 100.0}}}});
  return list;
}

Json drape_json(const DrapeReport& d) {
  return {{"garments", garments_json(d.garments)},
          {"fabric", d.fabric},
          {"dt_s", d.dt_s},
          {"substeps", d.substeps},
          {"frames", d.frames},
          {"particles", d.particles},
          {"thickness_mm", mm(d.thickness_m)},
          {"lifted_mm", mm(d.lifted_m)},
          {"frame_ms", {{"median", d.frame_ms_median}, {"p99", d.frame_ms_p99}, {"max", d.frame_ms_max}}},
          {"penetration",
           {{"count_over_1mm", d.penetration_over_1mm},
            {"max_mm", mm(d.penetration_max_m)},
            {"end_mm", mm(d.penetration_end_m)},
            {"worst_frame", d.worst_frame},
            {"of_frame_mm", all_mm(d.penetration_of_frame_m)},
            {"pierced_area_percent", d.pierced_share * 100.0}}},
          {"inside_union", d.inside_union},
          {"crossings",
           {{"start", d.crossings_start}, {"separated", d.crossings_separated}, {"end", d.crossings_end}}},
          {"stretch", {{"p95", d.stretch_p95}, {"max", d.stretch_max}}},
          {"median_speed_mm_s", mm(d.median_speed_m_s)},
          {"finite", d.finite},
          {"hash", engine::hex64(d.hash)}};
}

}  // namespace

std::string report_json(const PreparedBody& body, const DrapeReport* drape, const RunInfo& run) {
  const fitting::FitResult& fit = body.fit;
  Json warnings = Json::array();
  append_warnings(warnings, body.all_warnings());
  if (drape) append_warnings(warnings, drape->warnings);
  Json stages = Json::array();
  append_stages(stages, body.all_stages());
  if (drape) append_stages(stages, drape->stages);
  Json accuracy = accuracy_json(fit.accuracy);
  if (run.cropped) accuracy["of"] = "the whole body, before its proxy was cropped";

  Json report = {{"program", run.program},
                 {"command", run.command},
                 {"input", input_json(body.skin.input)},
                 {"shape", is_thing(body.skin) ? "any" : "person"},
                 {"height_m", height_m(body.skin)},
                 {"tier", proxy::name(fit.proxy.tier())},
                 {"threads", run.threads},
                 {"seed", run.seed},
                 {"hash", engine::hex64(fit.proxy.hash())},
                 {"ellipsoids", fit.proxy.ellipsoids().size()},
                 {"bytes", fit.proxy.bytes()},
                 {"mu_mm", {{"torso", mm(fit.mu_torso_m)}, {"limbs", mm(fit.mu_limbs_m)}}},
                 {"parts", parts_json(body)},
                 {"landmarks", landmarks_json(body.skin)},
                 {"accuracy", accuracy},
                 {"warnings", warnings},
                 {"stages", stages}};
  if (drape) report["drape"] = drape_json(*drape);
  if (drape && !drape->props.empty()) report["drape"]["props"] = props_json(drape->props);
  if (drape && drape->fit_map) report["drape"]["fit_map"] = fit_map_json(*drape->fit_map);
  if (drape && !drape->kept.empty()) {
    report["drape"]["ramp_s"] = drape->ramp_s;
    report["drape"]["base_poses"] = drape->base_poses;
    report["drape"]["kept"] = kept_json(drape->kept);
  }
  // Names of files and meshes need not be UTF-8; invalid bytes are replaced.
  return report.dump({.indent = 2, .replaces_invalid = true}) + "\n";
}

std::string labels_text(const SegmentedSkin& skin) {
  std::string text;
  const geometry::TriMesh& mesh = skin.input.skin;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const geometry::Vec3 p = skin.input.frame.to_file(mesh.positions[v]);
    for (const double x : p) {
      engine::append_number(text, x, 9);
      text.push_back(' ');
    }
    text.append(body::name(skin.anatomy.part[v])).push_back('\n');
  }
  return text;
}

}  // namespace bodice::tryon
