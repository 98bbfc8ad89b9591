#include "bind/skin_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "bind/texel_directions.hpp"
#include "tolerances.hpp"

namespace bodice::inline v0_1::binding {
namespace {

constexpr double kUnit16 = 32767.0, kWeight16 = 65535.0;
constexpr double kLeastWeight = 0.5 / kWeight16;

std::array<double, 3> barycentric(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  if (!(area2 > 0.0)) return {1.0, 0.0, 0.0};
  const auto share = [&](const Vec3& q, const Vec3& r) {
    return std::clamp((q - p).cross(r - p).dot(normal) / area2, 0.0, 1.0);
  };
  std::array<double, 3> shares = {share(b, c), share(c, a), share(a, b)};
  const double sum = shares[0] + shares[1] + shares[2];
  for (double& s : shares) s /= sum;
  return shares;
}

/// Joints of a point of a triangle: the mean of its corners' weights.
std::vector<std::pair<std::uint16_t, double>> mean_weights(const SkinnedBody& body,
                                                           const geometry::SurfacePoint& hit) {
  const geometry::Triangle& t = body.skin.triangles[hit.triangle];
  const auto& at = body.skin.positions;
  const std::array<double, 3> shares = barycentric(hit.point, at[t[0]], at[t[1]], at[t[2]]);
  std::map<std::uint16_t, double> sum;
  for (int corner = 0; corner < 3; ++corner)
    for (std::uint32_t i = body.weights.first[t[corner]]; i < body.weights.first[t[corner] + 1]; ++i)
      sum[body.weights.joint[i]] += shares[corner] * static_cast<double>(body.weights.weight[i]);
  return {sum.begin(), sum.end()};
}

std::int16_t rounded(double value) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -kUnit16, kUnit16)));
}

/// Texels beside one of an octahedral table.
std::array<int, 4> neighbors(int texel, int n) {
  const auto index = [n](int x, int y) {
    if (x < 0 || x >= n) return (n - 1 - y) * n + std::clamp(x, 0, n - 1);
    if (y < 0 || y >= n) return std::clamp(y, 0, n - 1) * n + n - 1 - x;
    return y * n + x;
  };
  const int x = texel % n, y = texel / n;
  return {index(x - 1, y), index(x + 1, y), index(x, y - 1), index(x, y + 1)};
}

/// One bundle of up to kBundle nodes, the last of which may repeat, and its joints.
void add_bundle(std::span<const SkinNode> nodes, double step_m, proxy::Binding& binding) {
  proxy::SkinBundle bundle;
  std::map<std::uint16_t, std::array<std::uint16_t, proxy::kBundle>> weights;  // by term
  const std::size_t first = binding.first_term[binding.first_term.size() - 2];
  const std::span terms = std::span(binding.terms).subspan(first);
  for (int lane = 0; lane < proxy::kBundle; ++lane) {
    const SkinNode& node = nodes[std::min<std::size_t>(static_cast<std::size_t>(lane), nodes.size() - 1)];
    bundle.texel[lane] = node.texel;
    for (int axis = 0; axis < 3; ++axis) bundle.position[axis][lane] = rounded(node.position[axis] / step_m);
    const auto square = proxy::octahedral_map(node.direction);
    for (int axis = 0; axis < 2; ++axis) bundle.direction[axis][lane] = rounded(kUnit16 * square[axis]);
    bundle.height[lane] = rounded(node.height_m / step_m);
    double sum = 0.0;
    const auto term_of = [&](std::uint16_t joint) {
      return std::ranges::find(terms, joint, &proxy::CarryTerm::joint);
    };
    for (const auto& [joint, weight] : node.weights)
      if (term_of(joint) != terms.end()) sum += weight;
    for (const auto& [joint, weight] : node.weights) {
      const auto term = term_of(joint);
      if (term == terms.end() || weight < kLeastWeight) continue;
      auto& of_term = weights.try_emplace(static_cast<std::uint16_t>(term - terms.begin())).first->second;
      of_term[lane] = static_cast<std::uint16_t>(std::lround(kWeight16 * std::min(1.0, weight / sum)));
    }
  }
  binding.bundles.push_back(bundle);
  for (const auto& [term, of_term] : weights) binding.entries.push_back({term, of_term});
  binding.first_entry.push_back(static_cast<std::uint32_t>(binding.entries.size()));
}

}  // namespace

std::vector<SkinNode> find_nodes(const NodeSearch& search, std::size_t k) {
  const proxy::ReliefTable& table = search.proxy.relief()[k];
  const geometry::Ellipsoid& e = search.proxy.ellipsoids()[k].shape;
  const double out_m = proxy::relief_reach(search.proxy.stature_m()).out_m;
  const int n = table.nodes_per_side;
  std::vector<SkinNode> nodes;
  for (int i = 0; i < n * n; ++i) {
    const Vec3 direction = texel_direction(i, n);
    const Vec3 normal = (e.axes * direction.cwiseQuotient(e.radii)).normalized();
    const proxy::ReliefTexel texel = search.proxy.texels()[table.first_texel + static_cast<std::size_t>(i)];
    const double h = double{table.h_offset_m} + double{table.h_scale_m} * texel.h / 255.0;
    const double a = double{table.a_offset} + double{table.a_scale} * texel.a / 255.0;
    const double zero_m = h / std::max(kLeastSlope, 1.0 - a / out_m);
    const auto hit = search.distance.closest_point_within(surface_point(e, direction) + zero_m * normal,
                                                          kNearSkin_m * search.scale);
    if (!hit) continue;
    const geometry::ClosestPoint on = geometry::closest_point(e, hit->point);
    const double nearest = nearest_distance(search.proxy.ellipsoids(), hit->point);
    if (on.signed_distance - nearest > kNearOwner_m * search.scale) continue;
    SkinNode node;
    node.texel = static_cast<std::uint16_t>(i);
    node.position = hit->point - e.center;
    node.direction = (e.axes.transpose() * (on.point - e.center)).cwiseQuotient(e.radii).normalized();
    node.height_m = on.signed_distance;
    node.weights = mean_weights(search.body, *hit);
    nodes.push_back(std::move(node));
  }
  return nodes;
}

std::vector<std::uint16_t> find_followers(std::span<const SkinNode> nodes, int nodes_per_side) {
  const auto texels = static_cast<std::size_t>(nodes_per_side) * static_cast<std::size_t>(nodes_per_side);
  constexpr std::uint16_t kNone = 0xffff;
  std::vector<std::uint16_t> followed(texels, kNone), wave;
  for (const SkinNode& node : nodes) {
    followed[node.texel] = node.texel;
    wave.push_back(node.texel);
  }
  while (!wave.empty()) {
    std::vector<std::uint16_t> next;
    for (const std::uint16_t texel : wave)
      for (const int beside : neighbors(texel, nodes_per_side))
        if (followed[static_cast<std::size_t>(beside)] == kNone) {
          followed[static_cast<std::size_t>(beside)] = followed[texel];
          next.push_back(static_cast<std::uint16_t>(beside));
        }
    wave = std::move(next);
  }
  for (std::size_t i = 0; i < texels; ++i)
    if (followed[i] == kNone) followed[i] = static_cast<std::uint16_t>(i);
  return followed;
}

void add_nodes(std::vector<SkinNode> nodes, double longest_radius_m, int nodes_per_side,
               proxy::Binding& binding) {
  const std::span terms = std::span(binding.terms).subspan(binding.first_term[binding.first_term.size() - 2]);
  std::erase_if(nodes, [&](const SkinNode& node) {  // moved by other joints than all of the ellipsoid's skin
    return std::ranges::none_of(node.weights, [&](const auto& weight) {
      return weight.second >= kLeastWeight &&
             std::ranges::find(terms, weight.first, &proxy::CarryTerm::joint) != terms.end();
    });
  });
  double most = longest_radius_m;
  for (const SkinNode& node : nodes) most = std::max(most, node.position.cwiseAbs().maxCoeff());
  const double step_m = most / kUnit16;
  binding.step_m.push_back(static_cast<float>(step_m));
  binding.first_follower.push_back(static_cast<std::uint32_t>(binding.followers.size()));
  if (!nodes.empty()) {
    const auto followed = find_followers(nodes, nodes_per_side);
    binding.followers.insert(binding.followers.end(), followed.begin(), followed.end());
  }
  // Nodes of the same joints share bundles, which then have few entries.
  std::ranges::stable_sort(nodes, [](const SkinNode& a, const SkinNode& b) {
    const auto heaviest = [](const SkinNode& node) {
      return std::ranges::max_element(node.weights, {}, [](const auto& w) { return w.second; })->first;
    };
    return heaviest(a) < heaviest(b);
  });
  for (std::size_t begin = 0; begin < nodes.size(); begin += proxy::kBundle)
    add_bundle(std::span(nodes).subspan(begin, std::min<std::size_t>(proxy::kBundle, nodes.size() - begin)),
               double{binding.step_m.back()}, binding);
  binding.first_bundle.push_back(static_cast<std::uint32_t>(binding.bundles.size()));
}

}  // namespace bodice::binding
