// Why a pose is refused, in sentences.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <bodice/engine/result.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::binding {

/// Fails with kInvalidArgument if the proxy is not bound.
engine::Result<void> check_bound(const proxy::BodyProxy& proxy);

/// Fails with kInvalidArgument unless there is a matrix for each joint of the bound proxy.
engine::Result<void> check_joints(const proxy::BodyProxy& bound, std::size_t matrices);

/// The error of a joint's matrix that cannot be taken.
engine::Error refused_joint(const std::string& joint, std::string_view reason);

}  // namespace bodice::binding
