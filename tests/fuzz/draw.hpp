// Memory of a host and descriptors that refer to it, drawn from the bytes of a case, for harnesses of the C
// interface.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <limits>

#include <bodice.h>

#include "harness.hpp"

namespace fuzz {

inline constexpr std::size_t kRoom = 1 << 16;  ///< bytes that a pointer has around it, on either side
inline constexpr std::size_t kMost = 200;      ///< elements of an array
static_assert(kMost * 128 + 128 < kRoom);

/// Memory of the host with a margin, so that strides of both signs stay inside.
struct Memory {
  std::array<std::uint8_t, 2 * kRoom> bytes;
  Memory() { bytes.fill(0); }
  void* middle() { return bytes.data() + kRoom; }
};

/// What a program has: handles, and arrays around each of which there is room.
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
  explicit Draw(Bytes& bytes) : bytes_(bytes) {}
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
  Bytes& bytes_;
};

/// A count of particles: few, or more than any call takes, which must be refused before an array is read.
inline std::size_t count_of(Draw& draw, Bytes& bytes) {
  if (draw.rarely()) return std::size_t{BODICE_MAX_PARTICLES} + 1 + bytes.next();
  if (draw.rarely()) return std::numeric_limits<std::size_t>::max() - bytes.next();
  return bytes.next() % kMost;
}

inline bodice_particles particles_of(World& world, Draw& draw, Bytes& bytes) {
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

/// Any status, and a sentence where it is a failure.
inline void check(bodice_status status) {
  FUZZ_CHECK(status >= BODICE_OK && status <= BODICE_VERSION_MISMATCH);
  if (status != BODICE_OK) FUZZ_CHECK(std::strlen(bodice_last_error()) > 10);
}

}  // namespace fuzz
