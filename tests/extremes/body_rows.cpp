#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/synth/body.hpp>

#include "rows.hpp"

namespace extremes {
namespace {

using namespace bodice;
using geometry::Vec3;

/// A change of the reference body: positions times scale, plus an offset.
struct Change {
  const char* name;
  double scale;
  Vec3 offset_m;
};

const Change kChanges[] = {
    {"scale 1e-6", 1e-6, Vec3::Zero()},        {"scale 1e-3", 1e-3, Vec3::Zero()},
    {"scale 1e3", 1e3, Vec3::Zero()},          {"scale 1e6", 1e6, Vec3::Zero()},
    {"10 km away", 1.0, Vec3(1e4, 0.0, -1e4)}, {"a millimeter tall, 10 km away", 6e-4, Vec3(-1e4, 1e4, 0.0)}};

struct Reference {
  synth::Body body = synth::make_body({}, {.vertices = 1500}).value();
  anatomy::Anatomy anatomy =
      anatomy::analyze({}, body.mesh, {.profile = body::find_profile("ansur2").value()}).value();

  geometry::TriMesh at(const Change& change) const {
    geometry::TriMesh mesh = body.mesh;
    for (Vec3& p : mesh.positions) p = change.scale * p + change.offset_m;
    return mesh;
  }
};

std::string check_anatomy(const Reference& r, const Change& change) {
  const auto mesh = r.at(change);
  const auto found = anatomy::analyze({}, mesh, {.profile = body::find_profile("ansur2").value()});
  if (!found.ok()) return found.error().message;
  const double stature = r.anatomy.stature_m;
  if (std::abs(found->stature_m / change.scale - stature) > 0.01 * stature) return "another stature";
  for (std::size_t k = 0; k < r.anatomy.landmarks.size(); ++k) {
    const Vec3 back = (found->landmarks[k].position - change.offset_m) / change.scale;
    if ((back - r.anatomy.landmarks[k].position).norm() > 0.01 * stature)
      return "landmark " + std::to_string(k) + " moved by over 1 % of stature";
  }
  std::size_t other = 0;
  for (std::size_t v = 0; v < found->part.size(); ++v) other += found->part[v] != r.anatomy.part[v];
  return expect(100 * other <= found->part.size(), std::to_string(other) + " vertices changed their part");
}

/// The mean gap in units of the reference, or nothing if the body is refused.
std::optional<double> gap_of(const Reference& r, const Change& change, proxy::Tier tier) {
  const auto mesh = r.at(change);
  const auto fit = fitting::fit({}, {mesh, r.body.part, change.scale * r.body.stature_m},
                                {.tier = tier, .max_ellipsoids = 16});
  if (!fit.ok()) return {};
  return fit->accuracy.gap_m.mean / change.scale;
}

std::string check_fit(const Reference& r, const Change& change, proxy::Tier tier) {
  static std::map<proxy::Tier, std::optional<double>> at_home;
  if (!at_home.contains(tier)) at_home[tier] = gap_of(r, {"at home", 1.0, Vec3::Zero()}, tier);
  const auto here = at_home[tier], there = gap_of(r, change, tier);
  if (!here || !there) return "refused";
  // The descent from rounded coordinates may end in a neighboring minimum.
  const double share = tier >= proxy::Tier::kTight ? 0.05 : 0.03;
  return expect(std::abs(*there - *here) <= share * *here,
                "gap " + std::to_string(*there) + " instead of " + std::to_string(*here));
}

}  // namespace

std::vector<Row> body_rows() {
  std::vector<Row> rows;
  const auto reference = std::make_shared<const Reference>();
  for (const Change& change : kChanges) {
    rows.push_back({"anatomy::analyze", change.name, [=] { return check_anatomy(*reference, change); }});
    for (const auto& [name, tier] :
         {std::pair("fit, paper", proxy::Tier::kPaper), std::pair("fit, solid", proxy::Tier::kSolid),
          std::pair("fit, tight", proxy::Tier::kTight), std::pair("fit, relief", proxy::Tier::kRelief)})
      rows.push_back({name, change.name, [=, tier = tier] { return check_fit(*reference, change, tier); }});
  }
  return rows;
}

}  // namespace extremes
