// Changes the body while frames run, in C++17: the next one is fitted beside them, and takes over between two
// frames.
//
//    frames            |1|2|3|4|5|6|7|8|9|...      the same particles, the same workspace
//    live collider      A A A A A A B B B
//    beside the frames |fit B .....|
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>
#include <vector>

#include <bodice.hpp>

namespace {

/// The mesh of a body: here the built-in one, elsewhere yours.
struct Mesh {
  std::vector<double> positions;
  std::vector<std::uint32_t> index;
  bodice_mesh view() {
    bodice_mesh mesh = bodice_default_mesh();
    mesh.position = {positions.data(), nullptr, nullptr, 0, BODICE_DOUBLE, 0};
    mesh.vertices = positions.size() / 3;
    mesh.index = index.data();
    mesh.triangles = index.size() / 3;
    return mesh;
  }
};

Mesh built_in(const bodice::Context& context, double stature_m) {
  bodice_skin* made = nullptr;
  bodice_skin_built_in(context.get(), 1, stature_m, nullptr, &made);
  const bodice::Skin skin(made);
  const auto info = skin.info();
  Mesh mesh;
  if (!info) return mesh;
  mesh.positions.resize(3 * std::size_t{info->vertices});
  mesh.index.resize(3 * std::size_t{info->triangles});
  bodice_skin_get_mesh(skin.get(), mesh.positions.data(), info->vertices, mesh.index.data(), info->triangles);
  return mesh;
}

int failed() {
  std::puts(bodice_last_error());
  return 1;
}

}  // namespace

int main() {
  auto context = bodice::Context::create();
  if (!context) return failed();
  bodice_fit_options options = bodice_default_fit_options();
  options.tier = BODICE_SOLID;
  Mesh small = built_in(*context, 1.5), tall = built_in(*context, 1.9);
  auto skin = bodice::Skin::from_mesh(*context, small.view());
  if (!skin) return failed();
  auto proxy = skin->fit(*context, options);
  if (!proxy) return failed();
  auto live = bodice::Collider::create(*context, *proxy);
  auto workspace = bodice::Workspace::create(*context);
  if (!live || !workspace) return failed();

  // The tall body begins: the mesh is copied, and the call returns.
  bodice_ticket* ticket = nullptr;
  const bodice_mesh next = tall.view();
  if (bodice_fit_begin(context->get(), &next, nullptr, &options, &ticket) != BODICE_OK) return failed();

  double drop[3] = {0.0, 1.7, 0.0};  // above the small body's head, and inside the tall one's
  bodice::Particles particles(1);
  particles.position(drop);
  int frames = 0, done = 0;
  for (; !done; ++frames) {
    if (!live->resolve(particles, *workspace)) return failed();
    if (bodice_ticket_poll(ticket, &done) != BODICE_OK) return failed();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const double before = drop[1];
  bodice_proxy* fitted = nullptr;
  const bodice_status status = bodice_ticket_take(ticket, nullptr, &fitted, nullptr);
  bodice_ticket_destroy(ticket);
  if (status != BODICE_OK) return failed();
  auto taller = bodice::Collider::create(*context, bodice::Proxy(fitted));
  if (!taller) return failed();
  live = std::move(taller);  // between two frames; the workspace stays
  if (!live->resolve(particles, *workspace)) return failed();
  std::printf("%d frames ran meanwhile; the particle moved from %.2f to %.2f, %.2f, %.2f\n", frames, before,
              drop[0], drop[1], drop[2]);
  const bool left = std::hypot(drop[0], drop[1] - 1.7, drop[2]) > 0.01;
  return before == 1.7 && left ? 0 : 1;
}
