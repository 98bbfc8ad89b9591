#include "scan_judge.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/proxy/proxy_distance.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bench {
namespace {

using bodice::anatomy::Anatomy;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;
using bodice::synth::Scan;
using bodice::synth::ScanPerson;

/// What is right: stature and landmarks beyond the error on the clean body, and how much of the skin is
/// something else, or how much of the body is left out; all but these are fractions of the stature.
constexpr double kStature = 0.015, kLandmark = 0.03, kForeign = 0.03, kMissing = 0.06;
/// What is absurd.
constexpr double kAbsurdStature = 0.2, kAbsurdForeign = 0.2;
/// A point this far from the body's skin belongs to something else; hair lies nearer.
constexpr double kElsewhere_m = 0.05;
/// Skin with more of the body so far outside of it lies inside of the body, and no scanner sees it: made
/// bodies overlap at armpits and between thighs.
constexpr double kOutside_m = 0.0005;
/// The landmarks that tests hold bars on; those of tailors are less certain.
constexpr int kMainLandmarks = 13;

double landmark_error(const Anatomy& anatomy, const ScanPerson& person, int landmark) {
  return (anatomy.landmarks[landmark].position - person.landmarks[landmark].position).norm() /
         person.stature_m;
}

/// How one surface lies on another.
struct Cover {
  double away = 0.0;    ///< share of the area that is elsewhere
  double mean_m = 0.0;  ///< distance of the rest
};

Cover cover(const TriMesh& skin, const TriMesh& other) {
  const bodice::geometry::MeshDistance distance({}, other);
  double all = 0.0, away = 0.0, sum = 0.0;
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    const double area = area_vector(skin, t).norm();
    const Vec3 middle = (skin.corner(t, 0) + skin.corner(t, 1) + skin.corner(t, 2)) / 3.0;
    all += area;
    if (const auto hit = distance.closest_point_within(middle, kElsewhere_m))
      sum += area * std::abs(hit->signed_distance);
    else
      away += area;
  }
  return all > 0.0 ? Cover{away / all, sum / std::max(all - away, 1e-300)} : Cover{1.0, 0.0};
}

bodice::anatomy::Options profile() {
  return {bodice::body::find_profile("ansur2").value()};
}

void measure_errors(const ScanPerson& person, Judged& judged) {
  const auto clean = bodice::anatomy::analyze({}, person.body, profile());
  const auto stature_error = [&](const Anatomy& found) {
    return std::abs(found.stature_m / person.stature_m - 1.0);
  };
  judged.stature = std::max(0.0, stature_error(*judged.anatomy) - (clean ? stature_error(*clean) : 0.0));
  for (int i = 0; i < kMainLandmarks; ++i) {
    const double error =
        landmark_error(*judged.anatomy, person, i) - (clean ? landmark_error(*clean, person, i) : 0.0);
    if (error <= judged.landmark) continue;
    judged.landmark = error;
    judged.worst = bodice::body::kLandmarkNames[i];
  }
  const Cover skin = cover(judged.skin, person.body);
  judged.foreign = skin.away;
  judged.seen_m = skin.mean_m;
  judged.missing = cover(person.body, judged.skin).away;
}

/// The person nearest to what was found: of several people any may be taken, with a warning.
const ScanPerson& nearest_person(const Scan& scan, const Anatomy& anatomy) {
  const auto sum = [&](const ScanPerson& person) {
    double errors = 0.0;
    for (int i = 0; i < kMainLandmarks; ++i) errors += landmark_error(anatomy, person, i);
    return errors;
  };
  return *std::min_element(scan.persons.begin(), scan.persons.end(),
                           [&](const auto& a, const auto& b) { return sum(a) < sum(b); });
}

/// Mean distance of the proxy's surface to what can be seen of the clean body, by area. `to_skin`: from the
/// truth's coordinates.
template <class ToSkin>
std::optional<double> proxy_error(const bodice::tryon::SegmentedSkin& skin, const TriMesh& truth,
                                  ToSkin&& to_skin) {
  const auto fit = bodice::fitting::fit({}, bodice::tryon::labeled(skin), {.measure_accuracy = false});
  if (!fit) return std::nullopt;
  const bodice::geometry::MeshDistance body({}, truth);
  constexpr std::size_t kEvery = 7;
  double sum = 0.0, all = 0.0;
  for (std::size_t t = 0; t < truth.triangles.size(); t += kEvery) {
    const Vec3 middle = (truth.corner(t, 0) + truth.corner(t, 1) + truth.corner(t, 2)) / 3.0;
    const Vec3 across = area_vector(truth, t);
    const double area = across.norm();
    if (!(area > 0.0) || body.signed_distance(middle + kOutside_m / area * across) < 0.0) continue;
    sum += area * std::abs(bodice::proxy::proxy_distance(fit->proxy, to_skin(middle)).distance);
    all += area;
  }
  return all > 0.0 ? std::optional(sum / all) : std::nullopt;
}

}  // namespace

Judged judge(const Scan& scan, const std::filesystem::path& file, bool with_proxy) {
  Judged judged;
  auto read = bodice::tryon::segment_file({}, file, {});
  if (!read) return judged.text = read.error().sentence(), judged;
  bool doubted = false;
  for (const auto& warning : read->warnings) {
    doubted |= !warning.note;
    judged.text += (judged.text.empty() ? "" : " ") + warning.code + (warning.note ? "" : "!");
  }
  const bodice::geometry::Frame frame = read->input.frame;
  const auto to_truth = [&](Vec3& p) { p = scan.frame.to_inside(frame.to_file(p)); };
  if (with_proxy)
    judged.proxy_m = proxy_error(*read, scan.persons.front().body,
                                 [&](const Vec3& p) { return frame.to_inside(scan.frame.to_file(p)); });
  judged.skin = std::move(read->input.skin);
  judged.anatomy = std::move(read->anatomy);
  for (Vec3& p : judged.skin.positions) to_truth(p);
  for (auto& mark : judged.anatomy->landmarks) to_truth(mark.position);
  judged.anatomy->stature_m *= scan.frame.meters_per_unit / frame.meters_per_unit;
  measure_errors(nearest_person(scan, *judged.anatomy), judged);
  const bool framed =
      frame.up == scan.frame.up && std::abs(frame.meters_per_unit / scan.frame.meters_per_unit - 1.0) < 0.01;
  if (!framed) judged.text += " (unit or axis wrong)";
  const bool absurd = judged.stature > kAbsurdStature || judged.foreign > kAbsurdForeign;
  const bool right = framed && judged.stature < kStature && judged.landmark < kLandmark &&
                     judged.foreign < kForeign && judged.missing < kMissing;
  judged.outcome = right ? (doubted ? kDoubted : kRight) : absurd ? kAbsurd : doubted ? kWarned : kSilent;
  return judged;
}

}  // namespace bench
