// Descriptors of the C interface: heads, sizes, strides, counts, kinds and numbers are garbage, and pointers
// are null or have as much memory as the descriptor states. Each call has a status with a sentence, and none
// writes elsewhere.
#include <string>
#include <vector>

#include "draw.hpp"

namespace {

using namespace fuzz;

void query(World& world, Draw& draw, Bytes& bytes) {
  const bodice_particles particles = particles_of(world, draw, bytes);
  bodice_query_options options = bodice_default_query_options();
  if (draw.rarely()) options.within_m = draw.real();
  if (draw.rarely()) options.first_order = draw.number();
  draw.head(options.head);
  bodice_contacts contacts = bodice_default_contacts();
  contacts.distance = {world.distance.middle(), draw.stride(), draw.scalar(), 0};
  if (draw.rarely()) contacts.point = draw.vectors(world.point);
  if (draw.rarely()) contacts.normal = draw.vectors(world.normal);
  if (draw.rarely()) contacts.ellipsoid = world.ellipsoid.data(), contacts.part = world.part.data();
  if (draw.rarely()) {
    contacts.contact = static_cast<bodice_contact*>(world.contact.middle());
    contacts.contact_stride = draw.stride();
  }
  draw.head(contacts.head);
  check(bodice_query(world.collider, draw.rarely() ? nullptr : &particles, draw.rarely() ? nullptr : &options,
                     draw.rarely() ? nullptr : world.workspace, draw.rarely() ? nullptr : &contacts));
}

void resolve(World& world, Draw& draw, Bytes& bytes) {
  const bodice_particles particles = particles_of(world, draw, bytes);
  bodice_resolve_options options = bodice_default_resolve_options();
  if (draw.rarely()) options.thickness_m = draw.real();
  if (draw.rarely()) options.friction = draw.real();
  if (draw.rarely()) options.max_push_m = draw.real();
  if (draw.rarely()) options.blend_m = draw.real();
  if (draw.rarely()) options.paper = draw.number();
  draw.head(options.head);
  bodice_contact_report report = bodice_default_contact_report();
  check(bodice_resolve(world.collider, &particles, draw.rarely() ? nullptr : &options, world.workspace,
                       draw.rarely() ? nullptr : &report));
}

void move(World& world, Draw& draw, Bytes& bytes) {
  bodice_pose pose = bodice_default_pose();
  auto* numbers = static_cast<float*>(world.matrices.middle());
  for (int i = 0; i < 48; ++i) numbers[i] = i % 13 == 0 ? 1.0f : 0.0f;
  for (int i = bytes.next() % 4; i > 0; --i) numbers[bytes.next() % 48] = draw.real();
  pose.matrices = numbers;
  pose.count = draw.rarely() ? static_cast<std::uint32_t>(draw.number()) : 3;
  pose.stride = draw.rarely() ? draw.stride() : 0;
  pose.scalar = draw.scalar();
  if (draw.rarely()) pose.layout = draw.number();
  if (draw.rarely()) pose.dt_s = static_cast<double>(draw.real());
  draw.head(pose.head);
  check(bytes.next() % 2 ? bodice_collider_move(world.collider, &pose)
                         : bodice_collider_pose(world.collider, &pose));
}

void exact(World& world, Draw& draw, Bytes& bytes) {
  bodice_mesh mesh = bodice_default_mesh();
  mesh.position = draw.vectors(world.position);
  mesh.vertices = count_of(draw, bytes);
  for (std::size_t i = 0; i < 300; ++i) world.index[i] = bytes.next() % 32;
  mesh.index = draw.rarely() ? nullptr : world.index.data();
  mesh.triangles = draw.rarely() ? std::numeric_limits<std::size_t>::max() / 3 : bytes.next() % 64;
  if (draw.rarely()) mesh.index_bytes = draw.number();
  draw.head(mesh.head);
  bodice_exact* made = nullptr;
  check(bodice_exact_create(world.context, &mesh, &made));
  bodice_exact_destroy(made);
}

void sweep(World& world, Draw& draw, Bytes& bytes) {
  bodice_particles particles = particles_of(world, draw, bytes);
  if (!draw.rarely()) particles.safe = draw.vectors(world.safe);
  bodice_contacts contacts = bodice_default_contacts();
  contacts.distance = {world.distance.middle(), draw.stride(), draw.scalar(), 0};
  if (draw.rarely()) contacts.ellipsoid = world.ellipsoid.data(), contacts.part = world.part.data();
  draw.head(contacts.head);
  std::array<float, kMost> fraction;
  check(bodice_sweep(world.collider, &particles, draw.real(), draw.rarely() ? nullptr : world.workspace,
                     draw.rarely() ? nullptr : fraction.data(), draw.rarely() ? &contacts : nullptr));
}

void cover(World& world, Draw& draw, Bytes& bytes) {
  const bodice_particles skin = particles_of(world, draw, bytes);
  std::size_t uncovered = 0;
  check(bodice_collider_cover(world.collider, draw.rarely() ? nullptr : &skin, draw.real(),
                              draw.rarely() ? nullptr : &uncovered));
}

void query_points(World& world, Draw& draw, Bytes& bytes) {
  const double point[3] = {static_cast<double>(draw.real()), 0.01 * bytes.next(),
                           static_cast<double>(draw.real())};
  std::array<bodice_contact, 8> contacts;
  std::size_t found = 0;
  const std::size_t capacity = bytes.next() % (contacts.size() + 1);
  check(bodice_query_point(world.collider, draw.rarely() ? nullptr : point,
                           draw.rarely() ? nullptr : &contacts[0]));
  contacts.back().ellipsoid = 12345;
  check(bodice_query_all(world.collider, draw.rarely() ? nullptr : point, draw.real(),
                         draw.rarely() ? nullptr : contacts.data(), capacity,
                         draw.rarely() ? nullptr : &found));
  if (capacity < contacts.size()) FUZZ_CHECK(contacts.back().ellipsoid == 12345);
}

void log(void*, std::int32_t, const char*) {}
void* allocate(void*, std::size_t bytes, std::size_t alignment) {
  return bytes > (1u << 20) ? nullptr
                            : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}
void release(void*, void* block, std::size_t) {
  std::free(block);
}
std::int64_t now(void*) {
  return 7;
}
void* enqueue(void*, const char*, void (*run)(void*), void* task) {
  run(task);
  return task;
}
void finish(void*, void*) {}

void make_context(Draw& draw, Bytes& bytes) {
  bodice_context_options options = bodice_default_context_options();
  if (draw.rarely()) options.abi = static_cast<std::uint32_t>(draw.number());
  options.workers = draw.rarely() ? draw.number() : bytes.next() % 3 + 1;
  options.log_level = draw.number();
  if (draw.rarely()) options.tasks_in_flight = draw.number();
  if (draw.rarely()) options.log = log;
  if (draw.rarely()) options.allocate = allocate;
  if (draw.rarely()) options.release = release;
  if (draw.rarely()) options.now_ns = now;
  if (draw.rarely()) options.enqueue = enqueue;
  if (draw.rarely()) options.finish = finish;
  if (options.workers > 8 && options.workers <= 1024)
    options.workers = 8;  // that many threads take long to start
  draw.head(options.head);
  bodice_context* made = nullptr;
  check(bodice_context_create(&options, &made));
  bodice_context_destroy(made);
}

/// Bytes of a proxy with some garbage among them; if they are read, the proxy is used.
void load_proxy(World& world, Draw& draw, Bytes& bytes) {
  std::size_t size = 0;
  const std::int32_t form = draw.rarely() ? draw.number() : bytes.next() % 2;
  const bodice_status formed = bodice_proxy_to_bytes(world.proxy, form, nullptr, 0, &size);
  check(formed);
  if (formed != BODICE_OK) return;
  std::vector<std::uint8_t> text(size);
  check(bodice_proxy_to_bytes(world.proxy, form, text.data(), draw.rarely() ? bytes.next() : text.size(),
                              &size));
  for (int i = bytes.next() % 4; i > 0; --i) {
    const std::size_t at = 256u * bytes.next() + bytes.next();
    text[at % text.size()] = bytes.next();
  }
  bodice_proxy* made = nullptr;
  check(
      bodice_proxy_from_bytes(world.context, text.data(), draw.rarely() ? bytes.next() : text.size(), &made));
  bodice_ellipsoid ellipsoid;
  double matrix[12];
  const auto joint = static_cast<std::uint32_t>(draw.number());
  const char* name = bodice_proxy_joint_name(made, joint);
  FUZZ_CHECK(!name || std::strlen(name) < size);
  check(bodice_proxy_get_bind(made, joint, draw.rarely() ? nullptr : matrix));
  std::uint16_t moved_by[2];
  float share[2];
  std::size_t count = 0;
  check(bodice_proxy_get_joint_weights(made, joint, draw.rarely() ? nullptr : moved_by, share,
                                       bytes.next() % 3, draw.rarely() ? nullptr : &count));
  check(bodice_proxy_get_ellipsoids(made, draw.rarely() ? nullptr : &ellipsoid, bytes.next() % 2));
  bodice_proxy_info info = bodice_default_proxy_info();
  draw.head(info.head);
  check(bodice_proxy_get_info(made, &info));
  bodice_collider* collider = nullptr;
  check(bodice_collider_create(world.context, made, &collider));
  const double point[3] = {0.1, 0.2, 0.3};
  bodice_contact contact;
  check(bodice_query_point(collider, point, &contact));
  bodice_particles skin = bodice_default_particles();
  skin.count = 1;
  skin.position = {const_cast<double*>(point), nullptr, nullptr, 0, BODICE_DOUBLE, 0};
  check(bodice_collider_cover(collider, &skin, 0.0f, nullptr));
  bodice_collider_destroy(collider);
  bodice_proxy_destroy(made);
}

}  // namespace

FUZZ_TARGET(capi) {
  Bytes bytes(data, size);
  static World* const world = [] {
    auto* made = new World;
    made->load(BODICE_FUZZ_PROXY);
    return made;
  }();
  auto* floats = static_cast<float*>(world->position.middle());
  Draw draw(bytes);
  for (int i = 0; i < 64; ++i) floats[i] = 0.01f * static_cast<float>(bytes.next());
  if (draw.rarely()) floats[bytes.next()] = draw.real();
  for (int call = 0; call < 8; ++call) {
    switch (bytes.next() % 10) {
      case 0:
        query(*world, draw, bytes);
        break;
      case 1:
        resolve(*world, draw, bytes);
        break;
      case 2:
        move(*world, draw, bytes);
        break;
      case 3:
        exact(*world, draw, bytes);
        break;
      case 4:
        sweep(*world, draw, bytes);
        break;
      case 5:
        query_points(*world, draw, bytes);
        break;
      case 6:
        make_context(draw, bytes);
        break;
      case 7:
        load_proxy(*world, draw, bytes);
        break;
      case 8:
        cover(*world, draw, bytes);
        break;
      default:
        bodice_query_options any;
        check(bodice_fill_defaults(draw.number(), &any,
                                   bytes.next() % 2 ? sizeof any : bytes.next() % sizeof any));
    }
  }
  return 0;
}
