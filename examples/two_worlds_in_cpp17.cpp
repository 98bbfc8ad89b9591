// Two worlds on two threads, in C++17: each has a context, a body and particles, and neither depends on the
// other.
//
//    thread 1:  context -- ball  -- particles       nothing is shared: the same bits as alone,
//    thread 2:  context -- ball' -- particles       and the sentence of a failure is that of its thread
#include <cstdio>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include <bodice.hpp>

namespace {

std::string ball(double radius_m) {
  const std::string r = std::to_string(radius_m);
  return R"({"format": "bodice-proxy", "version": 2, "tier": "solid", "metres_per_unit": 1.0, "up": "y",
    "stature": 1.7, "margin": 0.0, "source_hash": "0000000000000000", "ellipsoids": [{"part": "head",
    "center": [0, 1.6, 0], "radii": [)" +
         r + ", " + r + ", " + r +
         R"(], "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}], "relief": [], "texels": ""})";
}

/// What a world ends with: positions, and the sentence of a failure made on purpose.
struct World {
  double radius_m;
  std::vector<float> positions;
  std::string sentence;

  void run() {
    auto context = bodice::Context::create();
    const std::string bytes = ball(radius_m);
    auto proxy = bodice::Proxy::from_bytes(*context, bytes.data(), bytes.size());
    auto collider = bodice::Collider::create(*context, *proxy);
    auto workspace = bodice::Workspace::create(*context);
    positions.clear();
    for (int i = 0; i < 3000; ++i)
      positions.insert(positions.end(), {0.001f * static_cast<float>(i % 60), 1.8f, 0.0f});
    bodice::Particles particles(3000);
    particles.position(positions.data());
    for (int frame = 0; frame < 100; ++frame) {
      for (std::size_t i = 1; i < positions.size(); i += 3) positions[i] -= 0.001f;
      if (!collider->resolve(particles, *workspace)) return;
    }
    bodice_proxy* none = nullptr;
    bodice_proxy_from_bytes(context->get(), bytes.data(), radius_m < 0.09 ? 0 : 7, &none);
    sentence = bodice_last_error();
  }
};

bool same(const World& a, const World& b) {
  return !a.sentence.empty() && a.sentence == b.sentence &&
         std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * sizeof(float)) == 0;
}

}  // namespace

int main() {
  World small{0.08, {}, {}}, large{0.1, {}, {}}, small_alone = small, large_alone = large;
  small_alone.run();
  large_alone.run();
  std::thread other([&] { small.run(); });
  large.run();
  other.join();
  std::printf("%s\n%s\n", small.sentence.c_str(), large.sentence.c_str());
  const bool differ = small.positions != large.positions && small.sentence != large.sentence;
  return same(small, small_alone) && same(large, large_alone) && differ ? 0 : 1;
}
