// Contexts: hooks of the host, threads, no allocation once warm, and worlds that do not meet.
#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "capi/scene.hpp"
#include "simd/dispatch/kernels.hpp"

using namespace capi_test;

namespace {

/// Memory of the host, counted.
struct Counted {
  std::atomic<std::size_t> blocks{0}, bytes{0}, calls{0};
  std::atomic<bool> exhausted{false};
  std::atomic<int> left{1 << 30};  ///< blocks until it is exhausted
  static void* allocate(void* host, std::size_t bytes, std::size_t alignment) {
    auto& self = *static_cast<Counted*>(host);
    if (self.exhausted || self.left-- <= 0) return nullptr;
    ++self.blocks, ++self.calls, self.bytes += bytes;
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  }
  static void release(void* host, void* block, std::size_t bytes) {
    auto& self = *static_cast<Counted*>(host);
    --self.blocks, self.bytes -= bytes;
    std::free(block);
  }
};

std::vector<double> world_of(const Scene& scene, std::size_t count, std::uint64_t seed) {
  const Cloud cloud = cloud_around_limb(count, seed);
  std::vector<double> world;
  for (std::size_t i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis)
      world.push_back(cloud.position(i)[axis] + scene.engine.origin()[axis]);
  return world;
}

/// Some frames of falling particles; returns where they ended.
std::vector<double> simulate(const Scene& scene, std::uint64_t seed) {
  bodice::Workspace workspace = std::move(*bodice::Workspace::create(scene.context));
  std::vector<double> world = world_of(scene, 4000, seed);
  bodice::Particles particles(4000);
  particles.position(world.data());
  for (int frame = 0; frame < 20; ++frame) {
    for (std::size_t i = 1; i < world.size(); i += 3) world[i] -= 0.002;
    REQUIRE(scene.collider.resolve(particles, workspace));
  }
  return world;
}

/// Options of a context with its arrays in `memory`.
bodice_context_options counted_by(Counted& memory) {
  bodice_context_options options = bodice_default_context_options();
  options.host = &memory;
  options.allocate = Counted::allocate;
  options.release = Counted::release;
  return options;
}

}  // namespace

TEST_CASE("capi: arrays that grow with particles or texels lie in memory of the host, which gets it back") {
  Counted memory;
  {
    auto context = bodice::Context::create(counted_by(memory));
    REQUIRE(context);
    const auto engine_proxy = limb_proxy(true);
    const auto proxy = make_proxy(*context, engine_proxy);
    auto collider = bodice::Collider::create(*context, proxy);
    const std::size_t of_collider = memory.bytes;
    CHECK(of_collider >= 2 * engine_proxy.texels().size());
    memory.exhausted = true;
    CHECK(bodice::Collider::create(*context, proxy).status() == BODICE_OUT_OF_MEMORY);
    memory.exhausted = false;
    CHECK(memory.bytes == of_collider);
    auto workspace = bodice::Workspace::create(*context);
    context = bodice::Context();  // handles keep alive what they need
    std::vector<float> local(3000, 0.01f);
    bodice::Particles packed(1000);
    packed.position(local.data()).space = BODICE_LOCAL;
    for (int call = 0; call < 2; ++call) REQUIRE(collider->resolve(packed, *workspace));
    const std::size_t of_workspace = memory.bytes - of_collider;
    CHECK(of_workspace >= 1000 * 4 * sizeof(std::uint32_t));  // the spatial order and its keys, each twice
    CHECK(of_workspace <= 1000 * 110);
    std::vector<double> world(3000, 0.01);
    bodice::Particles particles(1000);
    particles.position(world.data());
    const std::size_t before = memory.calls;
    REQUIRE(collider->resolve(particles, *workspace));
    CHECK(memory.calls == before);  // doubles of the world are read where they are
    const std::vector<std::uint8_t> all(10000, 1);
    particles.mask = all.data();
    REQUIRE(collider->resolve(particles, *workspace));
    CHECK(memory.bytes >= of_collider + of_workspace + 1000 * sizeof(std::uint32_t));
    const std::size_t calls = memory.calls;
    REQUIRE(collider->resolve(particles, *workspace));
    CHECK(memory.calls == calls);

    memory.exhausted = true;
    std::vector<double> more(30000, 0.01);
    bodice::Particles many(10000);
    many.position(more.data());
    many.mask = all.data();
    CHECK(collider->resolve(many, *workspace).status() == BODICE_OUT_OF_MEMORY);
    CHECK(more == std::vector<double>(30000, 0.01));
    many.mask = nullptr;  // now it is the workspace that lacks memory
    CHECK(collider->resolve(many, *workspace).status() == BODICE_OUT_OF_MEMORY);
    CHECK(more == std::vector<double>(30000, 0.01));
    memory.exhausted = false;
    const auto report = collider->resolve(many, *workspace);
    REQUIRE(report);
    auto fresh = bodice::Workspace::create(*bodice::Context::create(counted_by(memory)));
    std::vector<double> again(30000, 0.01);
    many.position(again.data());
    REQUIRE(collider->resolve(many, *fresh));
    CHECK(again == more);  // a call that failed leaves no trace in the workspace
  }
  CHECK(memory.blocks == 0);
  CHECK(memory.bytes == 0);
}

TEST_CASE("capi: after a call that memory ran out in, wherever, the next one has the bits of any other") {
  Counted memory;
  auto context = bodice::Context::create(counted_by(memory));
  REQUIRE(context);
  const Scene scene(limb_proxy(true));
  const auto proxy = make_proxy(*context, limb_proxy(true));
  const auto collider = bodice::Collider::create(*context, proxy);
  const std::vector<double> start = world_of(scene, 3000, 8);
  bodice::Particles particles(3000);
  // Two calls, of which the second one makes the candidate cache.
  const auto resolve_twice = [&](const bodice::Workspace& workspace, std::vector<double>& world) {
    particles.position(world.data());
    for (int call = 0; call < 2; ++call) {
      const bodice_status status =
          bodice_resolve(collider->get(), &particles, nullptr, workspace.get(), nullptr);
      if (status != BODICE_OK) return status;
    }
    return bodice_status{BODICE_OK};
  };
  std::vector<double> expected = start;
  REQUIRE(resolve_twice(*bodice::Workspace::create(*context), expected) == BODICE_OK);
  REQUIRE(expected != start);
  int failures = 0;
  for (int blocks = 0;; ++blocks) {
    CAPTURE(blocks);
    const auto workspace = bodice::Workspace::create(*context);
    std::vector<double> world = start;
    memory.left = blocks;
    const bodice_status status = resolve_twice(*workspace, world);
    memory.left = 1 << 30;
    if (status == BODICE_OK) break;
    ++failures;
    CHECK(status == BODICE_OUT_OF_MEMORY);
    world = start;
    REQUIRE(resolve_twice(*workspace, world) == BODICE_OK);
    CHECK(world == expected);
  }
  CHECK(failures >= 6);  // five arrays of the order, and the cache
}

TEST_CASE("capi: a frame allocates nothing once warm, for any number of workers and form of arrays") {
  if (!bodice_test::counts_allocations()) return;
  for (const int workers : {1, 3}) {
    for (const bool relief : {false, true}) {
      CAPTURE(workers);
      CAPTURE(relief);
      Scene scene(limb_proxy(relief), workers);
      std::vector<double> world = world_of(scene, 5000, 3);
      std::vector<float> inverse_mass(5000, 1.0f);
      bodice::Particles particles(5000);
      particles.position(world.data()).inverse_mass(inverse_mass.data());
      std::vector<double> distance(5000);
      bodice_contacts contacts = bodice_default_contacts();
      contacts.distance = {distance.data(), 0, BODICE_DOUBLE, 0};
      std::vector<float> matrices;
      for (int k = 0; k < 9; ++k) matrices.insert(matrices.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
      bodice_pose pose = bodice_default_pose();
      pose.matrices = matrices.data();
      pose.count = 9;
      pose.dt_s = 0.016;
      const auto frame = [&] {
        REQUIRE(bodice_collider_move(scene.collider.get(), &pose) == BODICE_OK);
        REQUIRE(scene.collider.resolve(particles, scene.workspace));
        REQUIRE(scene.collider.query(particles, scene.workspace, contacts) == BODICE_OK);
      };
      frame();
      CHECK(bodice_test::allocations_when_warm(3, frame) == 0);
    }
  }
}

TEST_CASE("capi: any number of workers, and the host's jobs, give the same bits") {
  const auto proxy = limb_proxy(true);
  const std::vector<double> alone = simulate(Scene(proxy), 8);
  CHECK(simulate(Scene(proxy, 2), 8) == alone);
  CHECK(simulate(Scene(proxy, 5), 8) == alone);

  struct Host {
    static void* enqueue(void*, const char*, void (*run)(void*), void* task) {
      return new std::thread(run, task);
    }
    static void finish(void*, void* handle) {
      static_cast<std::thread*>(handle)->join();
      delete static_cast<std::thread*>(handle);
    }
  };
  bodice_context_options options = bodice_default_context_options();
  options.workers = 3;
  options.enqueue = Host::enqueue;
  options.finish = Host::finish;
  auto context = bodice::Context::create(options);
  REQUIRE_MESSAGE(context, bodice_last_error());
  Scene scene(proxy);
  scene.context = std::move(*context);
  scene.collider = std::move(*bodice::Collider::create(scene.context, scene.proxy));
  CHECK(simulate(scene, 8) == alone);
}

TEST_CASE("capi: two worlds on two threads give what each gives alone, and so does one collider for two") {
  const auto proxy = limb_proxy(true);
  const Scene one(proxy, 2), other(proxy, 2);
  const std::vector<double> first = simulate(one, 20), second = simulate(one, 21);
  for (const Scene* shared : {&other, &one}) {
    std::vector<double> a, b;
    std::thread thread([&] { a = simulate(one, 20); });
    b = simulate(*shared, 21);
    thread.join();
    CHECK(a == first);
    CHECK(b == second);
  }
}

TEST_CASE("capi: the sentence of a failure belongs to its thread") {
  const Scene scene(limb_proxy(false));
  bodice_pose pose = bodice_default_pose();
  CHECK(bodice_collider_pose(scene.collider.get(), &pose) == BODICE_INVALID_ARGUMENT);
  const std::string sentence = bodice_last_error();
  std::string elsewhere = "not read";
  std::thread([&] { elsewhere = bodice_last_error(); }).join();
  CHECK(elsewhere.empty());
  CHECK(bodice_last_error() == sentence);
}

TEST_CASE("capi: contexts that cannot be are refused") {
  const auto status_of = [](auto change) {
    bodice_context_options options = bodice_default_context_options();
    change(options);
    return bodice::Context::create(options).status();
  };
  CHECK(status_of([](auto&) {}) == BODICE_OK);
  CHECK(status_of([](auto& o) { o.workers = 0; }) == BODICE_OK);
  CHECK(status_of([](auto& o) { o.workers = -1; }) == BODICE_INVALID_ARGUMENT);
  CHECK(status_of([](auto& o) { o.workers = 1 << 20; }) == BODICE_INVALID_ARGUMENT);
  CHECK(status_of([](auto& o) { o.tasks_in_flight = 0; }) == BODICE_INVALID_ARGUMENT);
  CHECK(status_of([](auto& o) { o.allocate = Counted::allocate; }) == BODICE_INVALID_ARGUMENT);
  CHECK(status_of([](auto& o) { o.finish = [](void*, void*) {}; }) == BODICE_INVALID_ARGUMENT);
}

TEST_CASE("capi: the build names version, ABI and the instruction set that the engine chooses") {
  const std::string build = bodice_build();
  CAPTURE(build);
  CHECK(build.find("bodice 0.1.0, ABI 1") == 0);
  CHECK(bodice_version() == BODICE_VERSION);
  // The library finds the instruction sets itself; here Highway's own choice is linked.
  CHECK(build.ends_with("kernels " + std::string(bodice::collision::kernel_target())));
}
