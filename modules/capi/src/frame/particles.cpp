// Queries and responses of the C interface.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <bodice/collision/strided_particles.hpp>

#include "base/handles.hpp"
#include "base/structures.hpp"
#include "frame/collider.hpp"
#include "frame/host_contacts.hpp"
#include "frame/host_particles.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

namespace {

struct Origin {
  double xyz[3];
  explicit Origin(const bodice_collider& collider) {
    for (int axis = 0; axis < 3; ++axis) xyz[axis] = collider.collider.origin()[axis];
  }
};

Outcome local_point(const bodice_collider& collider, const double* point, float (&local)[3]) {
  if (!point) return invalid("The point is null.", "Pass three doubles.");
  for (int axis = 0; axis < 3; ++axis)
    local[axis] = static_cast<float>(point[axis] - collider.collider.origin()[axis]);
  return {};
}

/// Queries into the host's array of contacts, or through the workspace.
void query(const bodice_collider& collider, const capi::HostParticles& host,
           collision::StridedParticles particles, const collision::QueryOptions& options,
           bodice_workspace& workspace, const capi::HostContacts& to) {
  const engine::Context context = collider.context->engine_context();
  if (to.fits_engine()) {
    auto* contacts = reinterpret_cast<collision::Contact*>(to.contact.data);
    particles.shift_contacts = !host.is_local;
    collider.collider.query(context, particles, {contacts, particles.count}, workspace.engine, options);
    return;
  }
  collision::Contact* contacts = workspace.contacts.reserve(particles.count);
  collider.collider.query(context, particles, {contacts, particles.count}, workspace.engine, options);
  capi::EngineContacts from{contacts, particles.count, {0.0, 0.0, 0.0}, &collider.proxy};
  if (!host.is_local) std::copy_n(Origin(collider).xyz, 3, from.origin);
  write_contacts(context, from, to);
}

/// Contacts of one point that need no memory from the heap.
constexpr std::size_t kFewContacts = 256;

/// The workspace of the host, or one for this call.
bodice_workspace& workspace_for(const bodice_collider& collider, bodice_workspace* given,
                                std::optional<bodice_workspace>& own) {
  return given ? *given : own.emplace(collider.context);
}

bodice_contact_report as_c(const collision::ContactReport& from, std::uint64_t pinned) {
  auto to = capi::with_defaults<bodice_contact_report>();
  to.contacts = from.contacts;
  std::copy_n(from.contacts_by_part, BODICE_PARTS, to.contacts_by_part);
  to.unresolved = from.unresolved;
  to.pending = from.pending;
  to.pinched = from.pinched;
  to.not_finite = from.not_finite;
  to.pinned = pinned;
  to.deepest_m = from.deepest_m;
  return to;
}

/// None of the settings may be NaN, which the engine would take for zero or for no limit.
Outcome check_numbers(const bodice_resolve_options& options) {
  const std::pair<const char*, float> members[] = {{"thickness_m", options.thickness_m},
                                                   {"friction", options.friction},
                                                   {"max_push_m", options.max_push_m},
                                                   {"blend_m", options.blend_m}};
  for (const auto& [name, value] : members)
    if (std::isnan(value))
      return invalid(std::string("bodice_resolve_options.") + name + " is not a number.",
                     "Give what bodice_default_resolve_options() has, or another number.");
  return {};
}

}  // namespace

bodice_status bodice_workspace_create(const bodice_context* context, bodice_workspace** out) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the workspace"));
    BODICE_CHECK(capi::check_handle(context, "The context"));
    *out = new bodice_workspace(context->state);
    return {};
  });
}

void bodice_workspace_destroy(bodice_workspace* workspace) {
  delete workspace;
}

bodice_status bodice_query(const bodice_collider* collider, const bodice_particles* particles,
                           const bodice_query_options* given, bodice_workspace* workspace,
                           const bodice_contacts* contacts) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(collider, "The collider"));
    bodice_query_options options;
    BODICE_CHECK(capi::read(given, options, true));
    capi::HostParticles host;
    BODICE_CHECK(capi::read_particles(particles, host));
    capi::HostContacts to;
    BODICE_CHECK(capi::read_contacts(contacts, host.count, to));
    std::optional<bodice_workspace> own;
    bodice_workspace& memory = workspace_for(*collider, workspace, own);
    const capi::EngineParticles from = capi::to_query(host, Origin(*collider).xyz);
    query(*collider, host, from.particles,
          {.within_m = options.within_m,
           .accuracy = options.first_order ? collision::Accuracy::kFirstOrder : collision::Accuracy::kExact},
          memory, to);
    return {};
  });
}

bodice_status bodice_query_point(const bodice_collider* collider, const double point[3],
                                 bodice_contact* contact) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(collider, "The collider"));
    if (!contact) return invalid("The pointer to the contact is null.", "Pass one.");
    float local[3];
    BODICE_CHECK(local_point(*collider, point, local));
    *contact = capi::as_c(collider->collider.query(local), Origin(*collider).xyz);
    return {};
  });
}

bodice_status bodice_query_all(const bodice_collider* collider, const double point[3], float within_m,
                               bodice_contact* contacts, size_t capacity, size_t* found) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(collider, "The collider"));
    if (!found)
      return invalid("The pointer to the number of contacts is null.", "Pass the address of a size_t.");
    *found = 0;
    if (!contacts && capacity > 0)
      return invalid("The array of contacts is null.", "Pass one, or a capacity of 0.");
    float local[3];
    BODICE_CHECK(local_point(*collider, point, local));
    capacity = std::min(capacity, collider->proxy.ellipsoids().size());
    collision::Contact few[kFewContacts];  // a host's array need not have the alignment of the engine's
    std::vector<collision::Contact> many(capacity > kFewContacts ? capacity : 0);
    collision::Contact* const near = many.empty() ? few : many.data();
    *found = collider->collider.query_all(local, within_m, {near, capacity});
    for (std::size_t i = 0; i < std::min(*found, capacity); ++i)
      contacts[i] = capi::as_c(near[i], Origin(*collider).xyz);
    return {};
  });
}

bodice_status bodice_resolve(const bodice_collider* collider, const bodice_particles* particles,
                             const bodice_resolve_options* given, bodice_workspace* workspace,
                             bodice_contact_report* report) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(collider, "The collider"));
    bodice_resolve_options options;
    BODICE_CHECK(capi::read(given, options, true));
    BODICE_CHECK(capi::write(capi::with_defaults<bodice_contact_report>(), report, true));
    BODICE_CHECK(check_numbers(options));
    capi::HostParticles host;
    BODICE_CHECK(capi::read_particles(particles, host));
    std::optional<bodice_workspace> own;
    bodice_workspace& memory = workspace_for(*collider, workspace, own);
    const capi::EngineParticles from = capi::to_resolve(host, Origin(*collider).xyz, memory);
    engine::Context context = collider->context->engine_context();
    // Which of the values of an element that is listed twice is kept must not depend on threads.
    if (!from.all_differ) context.executor = &engine::inline_executor();
    const collision::ContactReport done = collider->collider.resolve(
        context, from.particles,
        {.response = options.paper ? collision::Response::kPaper : collision::Response::kClosestPoint,
         .thickness_m = options.thickness_m,
         .friction = options.friction,
         .max_push_m = options.max_push_m,
         .blend_m = options.blend_m},
        memory.engine);
    return capi::write(as_c(done, from.pinned), report, true);
  });
}
