
#include <bodice/colliders/reduce.hpp>
#include <bodice/engine/json.hpp>
#include <bodice/engine/text.hpp>

namespace bodice::inline v0_1::colliders {
namespace {

using engine::Json;

Json to_json(const SurfaceError& error) {
  return {{"mean", 1e3 * error.mean_m}, {"p95", 1e3 * error.p95_m}, {"worst", 1e3 * error.worst_m}};
}

}  // namespace

std::string cost_json(const proxy::BodyProxy& proxy, const ReductionCost& cost, const CostSubject& subject) {
  Json report = {{"format", subject.format}, {"collider", subject.collider}};
  report["proxy"] = engine::hex64(proxy.hash());
  report["measured_against"] = subject.reference;
  report["error_mm"] = to_json(cost.whole);
  for (std::size_t p = 0; p < cost.of_part.size(); ++p)
    if (cost.of_part[p].area_m2 > 0.0)
      report["error_of_part_mm"][std::string(body::kPartNames[p])] = to_json(cost.of_part[p]);
  return report.dump({.indent = 1}) + "\n";
}

}  // namespace bodice::colliders
