#pragma once

#include <optional>
#include <vector>

#include <bodice/binding/poser.hpp>
#include <bodice/collision/collider.hpp>

#include "base/context.hpp"

struct bodice_collider {
  bodice_collider(bodice::capi::SharedContext shared, const bodice::proxy::BodyProxy& made_from)
      : context(std::move(shared)), proxy(made_from), collider(made_from, context->memory()) {}

  bodice::capi::SharedContext context;
  bodice::proxy::BodyProxy proxy;
  bodice::collision::Collider collider;
  std::optional<bodice::binding::Poser> poser;            ///< absent if the proxy is not bound
  std::vector<bodice::proxy::JointMatrix> matrices;       ///< room for the pose that a call reads
  std::vector<bodice::geometry::Ellipsoid> moved_shapes;  ///< room for the ellipsoids that a call gives
  std::vector<bodice::geometry::Vec3> skin;               ///< room for the points that a call gives
};
