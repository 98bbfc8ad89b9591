// The exact distance to a mesh, as the C interface has it.
#include <cmath>
#include <limits>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/mesh_distance.hpp>

#include "arrays/mesh.hpp"
#include "base/context.hpp"
#include "base/handles.hpp"
#include "frame/host_contacts.hpp"
#include "frame/host_particles.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

struct bodice_exact {
  capi::SharedContext context;
  geometry::MeshDistance distance;
};

namespace {

constexpr std::size_t kExactATask = 64;  ///< particles a task: about half a millisecond

/// The contact of one particle; none if it is not finite.
geometry::SurfacePoint closest(const geometry::MeshDistance& distance, const double (&at)[3]) {
  const geometry::Vec3 point(at[0], at[1], at[2]);
  if (point.allFinite()) return distance.closest_point(point);
  geometry::SurfacePoint none;
  none.signed_distance = std::numeric_limits<double>::infinity();
  return none;
}

void write_one(const geometry::SurfacePoint& found, std::size_t i, const capi::HostContacts& to) {
  const double point[3] = {found.point.x(), found.point.y(), found.point.z()};
  const double normal[3] = {found.normal.x(), found.normal.y(), found.normal.z()};
  if (to.contact) {
    bodice_contact contact{};
    contact.distance = static_cast<float>(found.signed_distance);
    for (int axis = 0; axis < 3; ++axis) {
      contact.point[axis] = static_cast<float>(point[axis]);
      contact.normal[axis] = static_cast<float>(normal[axis]);
    }
    contact.ellipsoid = found.triangle;
    to.contact.set(i, contact);
  }
  if (to.distance && to.distance_is_double)
    to.distance.set(i, found.signed_distance);
  else if (to.distance)
    to.distance.set(i, static_cast<float>(found.signed_distance));
  if (to.point) to.point.set(i, point);
  if (to.normal) to.normal.set(i, normal);
  if (to.ellipsoid) to.ellipsoid[i] = found.triangle;
}

}  // namespace

bodice_status bodice_exact_create(const bodice_context* context, const bodice_mesh* given,
                                  bodice_exact** out) {
  static_assert(geometry::kNoIndex == BODICE_NO_ELLIPSOID);
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the exact distance"));
    BODICE_CHECK(capi::check_handle(context, "The context"));
    geometry::TriMesh mesh;
    BODICE_CHECK(capi::read_mesh(given, mesh));
    *out = new bodice_exact{context->state, geometry::MeshDistance(context->state->engine_context(), mesh)};
    return {};
  });
}

void bodice_exact_destroy(bodice_exact* exact) {
  delete exact;
}

bodice_status bodice_exact_query(const bodice_exact* exact, const bodice_particles* particles,
                                 const bodice_contacts* contacts) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(exact, "The exact distance"));
    capi::HostParticles host;
    BODICE_CHECK(capi::read_particles(particles, host));
    if (host.is_local)
      return invalid("The particles are in a local frame, which a mesh does not have.", "Give BODICE_WORLD.");
    capi::HostContacts to;
    BODICE_CHECK(capi::read_contacts(contacts, host.count, to));
    if (to.part) return invalid("A mesh has no parts to write.", "Leave bodice_contacts.part null.");
    engine::parallel_for(exact->context->engine_context(), host.count, kExactATask,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t i = begin; i < end; ++i) {
                             double at[3];
                             host.position.get(host.element(i), at);
                             write_one(closest(exact->distance, at), i, to);
                           }
                         });
    return {};
  });
}
