// Descriptors of the C interface: heads, sizes, strides, counts, kinds and numbers are garbage, and pointers
// are null or have as much memory as the descriptor states. Each call has a status with a sentence, and none
// writes elsewhere.
#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include <bodice.h>

#include "harness.hpp"

namespace {

constexpr std::size_t kRoom = 1 << 16;  ///< bytes that a pointer has around it, on either side
constexpr std::size_t kMost = 200;      ///< elements of an array
static_assert(kMost * 128 + 128 < kRoom);

/// Memory of the host with a margin, so that strides of both signs stay inside.
struct Memory {
  std::array<std::uint8_t, 2 * kRoom> bytes;
  Memory() { bytes.fill(0); }
  void* middle() { return bytes.data() + kRoom; }
};

struct World {
  bodice_context* context = nullptr;
  bodice_proxy* proxy = nullptr;
  bodice_collider* collider = nullptr;
  bodice_workspace* workspace = nullptr;
  Memory position, velocity, safe, mass, mask, contact, distance, point, normal, matrices;
  std::array<std::uint32_t, 4096> index{}, ellipsoid{};
  std::array<std::uint8_t, 4096> part{};

  World() {
    const bodice_context_options options = bodice_default_context_options();
    FUZZ_CHECK(bodice_context_create(&options, &context) == BODICE_OK);
  }
  void load(const char* file) {
    std::ifstream in(file, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    FUZZ_CHECK(bodice_proxy_from_bytes(context, text.data(), text.size(), &proxy) == BODICE_OK);
    FUZZ_CHECK(bodice_collider_create(context, proxy, &collider) == BODICE_OK);
    FUZZ_CHECK(bodice_workspace_create(context, &workspace) == BODICE_OK);
  }
};

/// Draws the members of descriptors from the bytes.
class Draw {
 public:
  explicit Draw(fuzz::Bytes& bytes) : bytes_(bytes) {}
  bool rarely() { return bytes_.next() % 16 == 1; }
  std::int32_t number() {
    const int high = bytes_.next();
    return static_cast<std::int32_t>((static_cast<std::uint32_t>(high) << (bytes_.next() % 25)) - 3u);
  }
  float real() {
    static constexpr float kOdd[] = {0.0f,  -0.0f, 1e-30f, 1e30f, std::numeric_limits<float>::infinity(),
                                     -1.0f, 0.01f, 3e38f,  0.3f,  std::numeric_limits<float>::quiet_NaN()};
    return kOdd[bytes_.next() % std::size(kOdd)];
  }
  std::int32_t scalar() { return rarely() ? number() : bytes_.next() % 2; }
  /// Any stride of few bytes: kMost elements stay within the room of a pointer.
  std::ptrdiff_t stride() { return static_cast<std::int8_t>(bytes_.next()); }
  bodice_vectors vectors(Memory& memory) {
    if (rarely()) return {};
    bodice_vectors out{memory.middle(), nullptr, nullptr, stride(), scalar(), 0};
    if (rarely()) out.y = out.x;
    if (rarely()) out.y = out.x, out.z = out.x;
    return out;
  }
  bodice_scalars scalars(Memory& memory) {
    if (!rarely()) return {};
    return {memory.middle(), stride(), scalar(), 0};
  }
  /// Breaks the head now and then.
  void head(bodice_head& head) {
    if (rarely()) head.cookie = static_cast<std::uint32_t>(number());
    if (rarely()) head.struct_size = static_cast<std::uint32_t>(bytes_.next()) % head.struct_size;
    if (rarely()) head.struct_size = 0x7fffffffu;
  }

 private:
  fuzz::Bytes& bytes_;
};

/// A count of particles: few, or more than any call takes, which must be refused before an array is read.
std::size_t count_of(Draw& draw, fuzz::Bytes& bytes) {
  if (draw.rarely()) return std::size_t{BODICE_MAX_PARTICLES} + 1 + bytes.next();
  if (draw.rarely()) return std::numeric_limits<std::size_t>::max() - bytes.next();
  return bytes.next() % kMost;
}

bodice_particles particles_of(World& world, Draw& draw, fuzz::Bytes& bytes) {
  bodice_particles out = bodice_default_particles();
  out.count = count_of(draw, bytes);
  out.position = draw.vectors(world.position);
  if (draw.rarely()) out.velocity = draw.vectors(world.velocity);
  if (draw.rarely()) out.safe = draw.vectors(world.safe);
  out.inverse_mass = draw.scalars(world.mass);
  if (draw.rarely()) {
    out.mask = static_cast<const std::uint8_t*>(world.mask.middle());
    out.mask_stride = draw.stride();
  }
  if (draw.rarely()) {
    for (std::size_t i = 0; i < kMost; ++i) world.index[i] = bytes.next();
    out.index = world.index.data();
    out.elements = draw.rarely() ? count_of(draw, bytes) : kMost;
  }
  if (draw.rarely()) out.space = draw.number();
  draw.head(out.head);
  return out;
}

void check(bodice_status status) {
  FUZZ_CHECK(status >= BODICE_OK && status <= BODICE_VERSION_MISMATCH);
  if (status != BODICE_OK) FUZZ_CHECK(std::strlen(bodice_last_error()) > 10);
}

void query(World& world, Draw& draw, fuzz::Bytes& bytes) {
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

void resolve(World& world, Draw& draw, fuzz::Bytes& bytes) {
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

void move(World& world, Draw& draw, fuzz::Bytes& bytes) {
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

void exact(World& world, Draw& draw, fuzz::Bytes& bytes) {
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

}  // namespace

FUZZ_TARGET(capi) {
  fuzz::Bytes bytes(data, size);
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
    switch (bytes.next() % 5) {
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
      default:
        bodice_query_options any;
        check(bodice_fill_defaults(draw.number(), &any,
                                   bytes.next() % 2 ? sizeof any : bytes.next() % sizeof any));
    }
  }
  return 0;
}
