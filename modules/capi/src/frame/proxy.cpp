// Proxies of the C interface.
#include "frame/proxy.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <string_view>

#include <bodice/proxy/proxy_file.hpp>

#include "base/handles.hpp"
#include "base/structures.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

namespace {

bool looks_like_json(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{';
}

bodice_ellipsoid as_c(const proxy::ProxyEllipsoid& from) {
  bodice_ellipsoid to{};
  for (int i = 0; i < 3; ++i) {
    to.center[i] = from.shape.center[i];
    to.radii[i] = from.shape.radii[i];
    for (int j = 0; j < 3; ++j) to.axes[i][j] = from.shape.axes(j, i);
  }
  to.part = static_cast<int32_t>(from.part);
  to.bone = from.bone;
  return to;
}

}  // namespace

bodice_status bodice_proxy_from_bytes(const bodice_context* context, const void* bytes, size_t size,
                                      bodice_proxy** out) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the proxy"));
    BODICE_CHECK(capi::check_handle(context, "The context"));
    if (!bytes || size == 0)
      return invalid("The bytes of the proxy are null or none.", "Pass the content of its file.");
    const std::span<const std::byte> given(static_cast<const std::byte*>(bytes), size);
    auto proxy = looks_like_json(given)
                     ? proxy::from_json({reinterpret_cast<const char*>(given.data()), given.size()})
                     : proxy::from_binary(given);
    if (!proxy) return proxy.error();
    *out = new bodice_proxy{context->state, std::move(proxy).value()};
    return {};
  });
}

bodice_status bodice_proxy_to_bytes(const bodice_proxy* handle, int32_t form, void* bytes, size_t capacity,
                                    size_t* size) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(handle, "The proxy"));
    if (!size) return invalid("The pointer to the size is null.", "Pass the address of a size_t.");
    if (form != BODICE_BINARY && form != BODICE_JSON)
      return invalid("There is no form " + std::to_string(form) + " of a proxy.",
                     "Give BODICE_BINARY or BODICE_JSON.");
    const auto copy = [&](const void* from, std::size_t count) -> Outcome {
      *size = count;
      if (!bytes) return {};
      if (count > capacity)
        return invalid("The proxy needs " + std::to_string(count) + " bytes, and there is room for " +
                           std::to_string(capacity) + ".",
                       "Call once with null to learn the size.");
      std::memcpy(bytes, from, count);
      return {};
    };
    if (form == BODICE_JSON) {
      const std::string text = proxy::to_json(handle->proxy);
      return copy(text.data(), text.size());
    }
    const std::vector<std::byte> binary = proxy::to_binary(handle->proxy);
    return copy(binary.data(), binary.size());
  });
}

void bodice_proxy_destroy(bodice_proxy* handle) {
  delete handle;
}

bodice_status bodice_proxy_get_info(const bodice_proxy* handle, bodice_proxy_info* info) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(handle, "The proxy"));
    const proxy::BodyProxy& proxy = handle->proxy;
    auto value = capi::with_defaults<bodice_proxy_info>();
    value.ellipsoids = static_cast<uint32_t>(proxy.ellipsoids().size());
    value.joints = proxy.binding() ? static_cast<uint32_t>(proxy.binding()->joint_names.size()) : 0;
    value.tier = static_cast<int32_t>(proxy.tier());
    value.stature_m = proxy.stature_m();
    value.margin_m = proxy.margin_m();
    value.hash = proxy.hash();
    value.bytes = proxy.bytes();
    return capi::write(value, info);
  });
}

bodice_status bodice_proxy_get_ellipsoids(const bodice_proxy* handle, bodice_ellipsoid* ellipsoids,
                                          size_t capacity) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(handle, "The proxy"));
    if (!ellipsoids && capacity > 0)
      return invalid("The array of ellipsoids is null.", "Pass one, or a capacity of 0.");
    const auto all = handle->proxy.ellipsoids();
    for (std::size_t k = 0; k < std::min(capacity, all.size()); ++k) ellipsoids[k] = as_c(all[k]);
    return {};
  });
}

const char* bodice_proxy_joint_name(const bodice_proxy* handle, uint32_t joint) {
  if (!handle || !handle->proxy.binding()) return nullptr;
  const auto& names = handle->proxy.binding()->joint_names;
  return joint < names.size() ? names[joint].c_str() : nullptr;
}

bodice_status bodice_proxy_get_bind(const bodice_proxy* handle, uint32_t joint, double matrix[12]) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(handle, "The proxy"));
    if (!matrix) return invalid("The pointer to the matrix is null.", "Pass 12 doubles.");
    const proxy::Binding* binding = handle->proxy.binding();
    const std::size_t joints = binding ? binding->bind.size() : 0;
    if (joint >= joints)
      return invalid(
          "There is no joint " + std::to_string(joint) + ": the proxy has " + std::to_string(joints) + ".",
          "See bodice_proxy_info.joints; `bodice fit avatar.glb` binds.");
    for (int i = 0; i < 12; ++i) matrix[i] = binding->bind[joint](i / 4, i % 4);
    return {};
  });
}

bodice_status bodice_proxy_get_joint_weights(const bodice_proxy* handle, uint32_t ellipsoid, uint16_t* joint,
                                             float* weight, size_t capacity, size_t* count) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(handle, "The proxy"));
    if (!count) return invalid("The pointer to the count is null.", "Pass the address of a size_t.");
    if ((!joint || !weight) && capacity > 0)
      return invalid("An array of joints or weights is null.", "Pass both, or a capacity of 0.");
    const auto ellipsoids = handle->proxy.ellipsoids();
    if (ellipsoid >= ellipsoids.size())
      return invalid("There is no ellipsoid " + std::to_string(ellipsoid) + ": the proxy has " +
                         std::to_string(ellipsoids.size()) + ".",
                     "See bodice_proxy_info.ellipsoids.");
    *count = 0;
    const proxy::Binding* binding = handle->proxy.binding();
    if (!binding) return {};
    const std::uint32_t first = binding->first_term[ellipsoid];
    *count = binding->first_term[ellipsoid + 1] - first;
    const geometry::Vec3& center = ellipsoids[ellipsoid].shape.center;
    for (std::size_t i = 0; i < std::min(capacity, *count); ++i) {
      const proxy::CarryTerm& term = binding->terms[first + i];
      // The last row of the term's matrix is the affine fit to the joint's weights of the skin.
      double at_center = term.matrix[15];
      for (int axis = 0; axis < 3; ++axis) at_center += term.matrix[4 * axis + 3] * center[axis];
      joint[i] = term.joint;
      weight[i] = static_cast<float>(at_center);
    }
    return {};
  });
}

const char* bodice_part_name(int32_t part) {
  static_assert(BODICE_PARTS == body::kPartCount && BODICE_ALL_PARTS == body::kAllPartCount);
  // The engine's names are string literals, which end with a zero.
  return part >= 0 && part < BODICE_ALL_PARTS ? body::name(static_cast<body::Part>(part)).data() : nullptr;
}
