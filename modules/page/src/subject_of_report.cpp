#include <array>
#include <filesystem>

#include <bodice/engine/json.hpp>
#include <bodice/page/page.hpp>

namespace bodice::inline v0_1::page {
namespace {

using engine::SortedJson;

const SortedJson& at(const SortedJson& object, const char* key) {
  static const SortedJson kNothing;
  const SortedJson* found = object.find(key);
  return found ? *found : kNothing;
}

std::string text(const SortedJson& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

double number(const SortedJson& value) {
  return value.is_number() ? value.get<double>() : 0.0;
}

std::optional<double> number_if_there(const SortedJson& value) {
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

/// The frame of positions in the report. A body of unknown unit was scaled; its landmarks are left out.
std::optional<geometry::Frame> frame_of(const SortedJson& input) {
  constexpr std::array<std::pair<const char*, double>, 6> kUnits = {
      {{"m", 1.0}, {"dm", 0.1}, {"cm", 0.01}, {"mm", 0.001}, {"inch", 0.0254}, {"ft", 0.3048}}};
  const std::string unit = text(at(input, "unit")), up = text(at(input, "up"));
  geometry::Frame frame;
  frame.up = up == "x" ? geometry::Axis::kX : up == "z" ? geometry::Axis::kZ : geometry::Axis::kY;
  for (const auto& [name, meters] : kUnits)
    if (unit == name) {
      frame.meters_per_unit = meters;
      return frame;
    }
  return std::nullopt;
}

std::vector<NamedPoint> landmarks_of(const SortedJson& report) {
  std::vector<NamedPoint> points;
  const auto frame = frame_of(at(report, "input"));
  if (!frame) return points;
  for (const SortedJson& landmark : at(report, "landmarks")) {
    const SortedJson& position = at(landmark, "position");
    if (!position.is_array() || position.size() != 3 || !(number(at(landmark, "confidence")) > 0.0)) continue;
    points.push_back({text(at(landmark, "name")),
                      frame->to_inside({number(position[0]), number(position[1]), number(position[2])})});
  }
  return points;
}

DrapeCurves curves_of(const SortedJson& drape) {
  DrapeCurves curves;
  const SortedJson& penetration = at(drape, "penetration");
  for (const SortedJson& depth : at(penetration, "of_frame_mm"))
    curves.penetration_mm.push_back(number(depth));
  const auto frames = static_cast<double>(curves.penetration_mm.size());
  const double worst = number(at(penetration, "worst_frame"));
  if (worst >= 1.0 && worst <= frames) curves.worst_frame = static_cast<int>(worst);
  for (const SortedJson& kept : at(drape, "kept"))
    curves.kept.push_back({number(at(kept, "time_s")), number(at(at(kept, "proxy_error_mm"), "mean")),
                           number(at(at(kept, "penetration"), "max_mm"))});
  curves.dt_s = number(at(drape, "dt_s"));
  return curves;
}

}  // namespace

engine::Result<PageSubject> subject_of_report(const std::string& report, const std::string& file) {
  const SortedJson read = SortedJson::parse_or_null(report);
  if (!at(read, "input").is_object() || !at(read, "accuracy").is_object())
    return engine::Error{engine::ErrorCode::kUnreadable, "'" + file + "' is no report of bodice.",
                         "Give what --report of fit or drape wrote."};
  PageSubject subject;
  const std::string body = text(at(at(read, "input"), "file"));
  subject.title = body.empty() ? "the built-in body" : std::filesystem::path(body).filename().string();
  subject.tier = text(at(read, "tier"));
  subject.hash = text(at(read, "hash"));
  const SortedJson& gap = at(at(read, "accuracy"), "gap_mm");
  subject.gap_mean_mm = number_if_there(at(gap, "mean"));
  subject.gap_p95_mm = number_if_there(at(gap, "p95"));
  subject.landmarks = landmarks_of(read);
  for (const SortedJson& w : at(read, "warnings"))
    subject.warnings.push_back({text(at(w, "code")), text(at(w, "part")), text(at(w, "message")),
                                text(at(w, "remedy")), at(w, "note") == SortedJson(true)});
  for (const SortedJson& s : at(read, "stages"))
    subject.stages.push_back({text(at(s, "name")), number(at(s, "ms"))});
  if (at(read, "drape").is_object()) subject.drape = curves_of(at(read, "drape"));
  subject.report = report;
  return subject;
}

}  // namespace bodice::page
