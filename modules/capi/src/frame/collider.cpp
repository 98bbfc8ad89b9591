// Colliders of the C interface, and their poses.
#include "frame/collider.hpp"

#include "arrays/matrices.hpp"
#include "base/handles.hpp"
#include "base/structures.hpp"
#include "frame/moved_ellipsoid.hpp"
#include "frame/proxy.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

bodice_status bodice_collider_create(const bodice_context* context, const bodice_proxy* proxy,
                                     bodice_collider** out) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the collider"));
    BODICE_CHECK(capi::check_handle(context, "The context"));
    BODICE_CHECK(capi::check_handle(proxy, "The proxy"));
    auto made = std::make_unique<bodice_collider>(context->state, proxy->proxy);
    made->moved_shapes.resize(proxy->proxy.ellipsoids().size());
    made->matrices.resize(proxy->proxy.ellipsoids().size());
    if (proxy->proxy.binding()) {
      auto poser = binding::Poser::make(proxy->proxy);
      if (!poser) return poser.error();
      made->poser.emplace(std::move(poser).value());
      made->matrices.resize(made->poser->joints());
    }
    *out = made.release();
    return {};
  });
}

void bodice_collider_destroy(bodice_collider* collider) {
  delete collider;
}

bodice_status bodice_collider_get_origin(const bodice_collider* collider, double origin[3]) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(collider, "The collider"));
    if (!origin) return invalid("The pointer to the origin is null.", "Pass three doubles.");
    for (int i = 0; i < 3; ++i) origin[i] = collider->collider.origin()[i];
    return {};
  });
}

bodice_status bodice_collider_pose(bodice_collider* collider, const bodice_pose* given) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(collider, "The collider"));
    bodice_pose pose;
    BODICE_CHECK(capi::read(given, pose));
    if (!collider->poser)
      return invalid(
          "The collider's proxy is not bound to bones.",
          "Fit a rigged body (`bodice fit avatar.glb`), or move ellipsoids by bodice_collider_move().");
    BODICE_CHECK(capi::check_matrices(pose, collider->poser->joints(), "joints"));
    capi::read_matrices(pose, collider->matrices);
    const auto posed = collider->poser->pose(collider->context->engine_context(), collider->matrices,
                                             {.tables = pose.tables != 0, .within = {}});
    if (!posed) return posed.error();
    if (!collider->collider.pose(collider->poser->posed(), pose.dt_s))
      return {BODICE_INTERNAL, "The collider does not take the pose of its own proxy. Please report this."};
    return {};
  });
}

bodice_status bodice_collider_move(bodice_collider* collider, const bodice_pose* given) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(collider, "The collider"));
    bodice_pose pose;
    BODICE_CHECK(capi::read(given, pose));
    const auto rest = collider->proxy.ellipsoids();
    if (collider->poser)
      return invalid("The collider's proxy is bound to bones, which carry its ellipsoids.",
                     "Use bodice_collider_pose().");
    BODICE_CHECK(capi::check_matrices(pose, rest.size(), "ellipsoids"));
    capi::read_matrices(pose, collider->matrices);
    for (std::size_t k = 0; k < rest.size(); ++k) {
      const std::string_view reason =
          capi::move_ellipsoid(rest[k].shape, collider->matrices[k], collider->moved_shapes[k]);
      if (!reason.empty())
        return invalid("The matrix of ellipsoid " + std::to_string(k) + " " + std::string(reason) + ".",
                       "Give a rotation, a translation and at most a uniform scale.");
    }
    if (!collider->collider.move_to(collider->moved_shapes, pose.dt_s))
      return {BODICE_INTERNAL,
              "The collider does not take ellipsoids that were checked. Please report this."};
    return {};
  });
}
