#include "frame/host_particles.hpp"

#include <algorithm>

#include "base/handles.hpp"
#include "base/structures.hpp"

namespace bodice::inline v0_1::capi {
namespace {

collision::StridedVectors as_engine(const StridedVectors& from) {
  const auto bytes = [](const Strided& numbers) { return reinterpret_cast<std::byte*>(numbers.data); };
  return {bytes(from.x), bytes(from.y), bytes(from.z), from.x.stride, from.is_double};
}

/// Whether the `count` elements differ. `claim` has room for as many numbers as the arrays have elements, and
/// only those that were written before are read.
bool are_distinct(const std::uint32_t* element, std::size_t count, HostArray<std::uint32_t>& claim,
                  std::size_t elements) {
  bool rising = true;
  for (std::size_t i = 1; i < count; ++i) rising &= element[i - 1] < element[i];
  if (rising) return true;
  std::uint32_t* const last = claim.reserve(elements);
  for (std::size_t i = 0; i < count; ++i) last[element[i]] = static_cast<std::uint32_t>(i);
  bool differ = true;
  for (std::size_t i = 0; i < count; ++i) differ &= last[element[i]] == i;
  return differ;
}

}  // namespace

bool HostParticles::is_pinned(std::size_t i) const {
  if (mask && mask.get<std::uint8_t>(i) == 0) return true;
  if (!inverse_mass) return false;
  return !((mass_is_double ? inverse_mass.get<double>(i) : double{inverse_mass.get<float>(i)}) > 0.0);
}

Outcome read_particles(const bodice_particles* given, HostParticles& out) {
  bodice_particles particles;
  BODICE_CHECK(read(given, particles));
  if (particles.count > BODICE_MAX_PARTICLES || particles.elements > BODICE_MAX_PARTICLES)
    return invalid(
        "There are " + std::to_string(std::max(particles.count, particles.elements)) + " particles.",
        "Pass at most BODICE_MAX_PARTICLES a call.");
  if (particles.space != BODICE_WORLD && particles.space != BODICE_LOCAL)
    return invalid("bodice_particles.space is " + std::to_string(particles.space) + ".",
                   "Give BODICE_WORLD or BODICE_LOCAL.");
  const std::size_t elements = particles.index ? particles.elements : particles.count;
  BODICE_CHECK(read_vectors(particles.position, elements, "bodice_particles.position", out.position));
  BODICE_CHECK(read_vectors(particles.velocity, elements, "bodice_particles.velocity", out.velocity));
  BODICE_CHECK(read_vectors(particles.safe, elements, "bodice_particles.safe", out.safe));
  BODICE_CHECK(read_scalars(particles.inverse_mass, elements, "bodice_particles.inverse_mass",
                            out.inverse_mass, out.mass_is_double));
  BODICE_CHECK(read_elements(const_cast<std::uint8_t*>(particles.mask), particles.mask_stride, 1, elements,
                             "bodice_particles.mask", out.mask));
  if (particles.count > 0 && !out.position)
    return invalid("bodice_particles.position has no arrays.", "Set position.x, or x, y and z.");
  for (std::size_t i = 0; particles.index && i < particles.count; ++i)
    if (particles.index[i] >= elements)
      return invalid("bodice_particles.index[" + std::to_string(i) + "] is " +
                         std::to_string(particles.index[i]) + ", and there are " + std::to_string(elements) +
                         " elements.",
                     "Set `elements` to the length of the arrays, and keep the index below it.");
  out.count = particles.count;
  out.elements = elements;
  out.index = particles.index;
  out.is_local = particles.space == BODICE_LOCAL;
  return {};
}

EngineParticles to_query(const HostParticles& host, const double (&origin)[3]) {
  EngineParticles out;
  out.particles.count = host.count;
  out.particles.element = host.index;
  out.particles.position = as_engine(host.position);
  if (!host.is_local) std::copy_n(origin, 3, out.particles.origin);
  return out;
}

EngineParticles to_resolve(const HostParticles& host, const double (&origin)[3],
                           bodice_workspace& workspace) {
  EngineParticles out = to_query(host, origin);
  collision::StridedParticles& particles = out.particles;
  particles.velocity = as_engine(host.velocity);
  particles.safe = as_engine(host.safe);
  if (host.mask || host.inverse_mass) {
    std::uint32_t* element = workspace.element.reserve(host.count);
    particles.element = element;
    particles.count = 0;
    for (std::size_t i = 0; i < host.count; ++i)
      if (const std::size_t e = host.element(i); !host.is_pinned(e))
        element[particles.count++] = static_cast<std::uint32_t>(e);
    out.pinned = host.count - particles.count;
  }
  if (host.index)
    out.all_differ = are_distinct(particles.element, particles.count, workspace.claim, host.elements);
  return out;
}

}  // namespace bodice::capi
