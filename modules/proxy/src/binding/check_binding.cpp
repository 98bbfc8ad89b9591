#include "binding/check_binding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bodice::inline v0_1::proxy {
namespace {

constexpr std::size_t kMostJoints = 65535;

/// Whether the firsts ascend from 0 to `end` in `count` steps.
bool are_ranges(const std::vector<std::uint32_t>& first, std::size_t count, std::size_t end) {
  return first.size() == count + 1 && first.front() == 0 && first.back() == end &&
         std::is_sorted(first.begin(), first.end());
}

bool is_finite(double value) {
  return std::abs(value) <= kLargestEntry;
}

std::string counts_fault(const Binding& b, const BodyProxy::Data& data) {
  const std::size_t ellipsoids = data.ellipsoids.size();
  if (b.joint_names.size() > kMostJoints || b.bind.size() != b.joint_names.size())
    return "the binding has no bind matrix for each of its joints";
  if (std::ranges::any_of(b.joint_names, [](const std::string& name) { return name.size() > kLongestName; }))
    return "a joint's name has more than 65,535 bytes";
  if (!are_ranges(b.first_term, ellipsoids, b.terms.size()))
    return "the binding does not have terms for each ellipsoid";
  if (!are_ranges(b.first_bundle, ellipsoids, b.bundles.size()) || b.step_m.size() != ellipsoids ||
      b.first_follower.size() != ellipsoids)
    return "the binding does not have bundles for each ellipsoid";
  if (!are_ranges(b.first_entry, b.bundles.size(), b.entries.size()))
    return "the binding does not have joints for each bundle";
  if (b.burial.size() != data.texels.size()) return "the binding does not have a burial for each texel";
  if (!(b.burial_step_m >= 0.0f && b.burial_step_m <= 1e15f)) return "the binding's burial is not finite";
  return {};
}

std::string table_fault(const Binding& b, const BodyProxy::Data& data, std::size_t k) {
  if (data.relief.empty()) return "the binding has bundles for an ellipsoid without a table";
  const std::size_t n = data.relief[k].nodes_per_side;
  const std::size_t texels = n * n;
  if (n < 2 || n > kMostBoundNodes || b.first_follower[k] + texels > b.followers.size())
    return "the binding's followers do not fit a table";
  for (std::size_t i = 0; i < texels; ++i)
    if (b.followers[b.first_follower[k] + i] >= texels) return "a follower is beyond its table";
  const std::size_t terms = b.first_term[k + 1] - b.first_term[k];
  for (std::size_t i = b.first_bundle[k]; i < b.first_bundle[k + 1]; ++i) {
    for (const std::uint16_t texel : b.bundles[i].texel)
      if (texel >= texels) return "a bundle's texel is beyond its table";
    for (std::size_t e = b.first_entry[i]; e < b.first_entry[i + 1]; ++e)
      if (b.entries[e].term >= terms) return "a bundle's joint is not one of its ellipsoid";
  }
  return {};
}

}  // namespace

std::string binding_fault(const Binding& b, const BodyProxy::Data& data) {
  if (std::string what = counts_fault(b, data); !what.empty()) return what;
  for (const JointMatrix& bind : b.bind)
    if (!std::all_of(bind.data(), bind.data() + 12, is_finite)) return "a bind matrix is not finite";
  for (const CarryTerm& term : b.terms)
    if (term.joint >= b.joint_names.size() || !std::ranges::all_of(term.matrix, is_finite))
      return "a term of the binding has no joint or is not finite";
  for (std::size_t k = 0; k < data.ellipsoids.size(); ++k) {
    if (b.first_term[k] == b.first_term[k + 1]) return "ellipsoid " + std::to_string(k) + " has no joint";
    if (data.ellipsoids[k].bone >= static_cast<std::int64_t>(b.joint_names.size()))
      return "ellipsoid " + std::to_string(k) + " has a bone beyond the joints";
    if (b.first_bundle[k] == b.first_bundle[k + 1]) continue;
    if (!(b.step_m[k] > 0.0f && b.step_m[k] <= 1e15f)) return "a unit of the binding is not a length";
    if (std::string what = table_fault(b, data, k); !what.empty()) return what;
  }
  return {};
}

}  // namespace bodice::proxy
