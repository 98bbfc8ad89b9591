#include "peer_rows.hpp"

#include <cstdio>

namespace bench {
namespace {

std::vector<std::size_t> one_of(std::size_t every, std::size_t count) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; i += every) chosen.push_back(i);
  return chosen;
}

Cloud thinned(const Cloud& cloud, std::size_t every) {
  Cloud result;
  for (const std::size_t i : one_of(every, cloud.size())) result.add(cloud.at(i));
  return result;
}

}  // namespace

SampledPeer::SampledPeer(Peer& one, const Cloud& ordered, const Cloud& shuffled)
    : peer(one), coherent(thinned(ordered, one.one_of)), random(thinned(shuffled, one.one_of)) {}

void add_peer(SampledPeer& sampled, const std::vector<double>& truth, std::vector<float>& distances,
              std::vector<Row>& rows) {
  const Peer& peer = sampled.peer;
  std::vector<double> sampled_truth;
  for (const std::size_t i : one_of(peer.one_of, truth.size())) sampled_truth.push_back(truth[i]);
  peer.query(sampled.coherent, distances);
  std::printf("%s: error %s mm, build %.1f ms, %.0f kB\n", peer.name.c_str(),
              error_of(distances, sampled_truth, peer.bytes > 0.0, peer.reach_m).c_str(), peer.build_ms,
              1e-3 * peer.bytes);
  const auto n = static_cast<double>(sampled_truth.size());
  rows.push_back({peer.name + ", coherent", [&] { peer.query(sampled.coherent, distances); }, n});
  rows.push_back({peer.name + ", random", [&] { peer.query(sampled.random, distances); }, n});
}

}  // namespace bench
