// Based on: Khronos Group. glTF 2.0 Specification. 2021. - sections 3.7.3 (skins), 3.11 (animations)
#include "import/source/gltf_skin.hpp"

#include <string>

namespace bodice::inline v0_1::io {

namespace {

using engine::SortedJson;

rig::Interpolation interpolation_of(const SortedJson& sampler) {
  const std::string name = text_at(sampler, "interpolation");
  if (name == "STEP") return rig::Interpolation::kStep;
  return name == "CUBICSPLINE" ? rig::Interpolation::kCubic : rig::Interpolation::kLinear;
}

rig::Vec3 make(const double* at, const rig::Vec3&) {
  return {at[0], at[1], at[2]};
}
Eigen::Quaterniond make(const double* at, const Eigen::Quaterniond&) {
  return {at[3], at[0], at[1], at[2]};
}

template <class T>
bool read(const GltfDocument& document, const SortedJson& sampler, std::size_t components,
          rig::Keys<T>& keys) {
  const auto time_at = index_at(sampler, "input"), value_at = index_at(sampler, "output");
  const auto time = time_at ? document.numbers(*time_at) : std::nullopt;
  const auto value = value_at ? document.numbers(*value_at) : std::nullopt;
  const rig::Interpolation interpolation = interpolation_of(sampler);
  const std::size_t per_key = interpolation == rig::Interpolation::kCubic ? 3 : 1;
  if (!time || !value || time->components != 1 || value->components != components ||
      value->count != per_key * time->count)
    return false;
  keys.interpolation = interpolation;
  keys.time_s = time->values;
  keys.value.clear();
  for (std::size_t i = 0; i < value->count; ++i)
    keys.value.push_back(make(value->values.data() + i * components, T()));
  return true;
}

}  // namespace

bool visit_weights(const GltfDocument& document, const SortedJson& attributes, std::size_t set,
                   engine::FunctionRef<void(std::uint32_t, double, double)> visit) {
  const auto joints_at = index_at(attributes, ("JOINTS_" + std::to_string(set)).c_str());
  const auto weights_at = index_at(attributes, ("WEIGHTS_" + std::to_string(set)).c_str());
  if (!joints_at || !weights_at) return false;
  const auto joints = document.numbers(*joints_at), weights = document.numbers(*weights_at);
  if (!joints || !weights || joints->components != 4 || weights->components != 4 ||
      joints->count != weights->count)
    return false;
  for (std::size_t i = 0; i < weights->values.size(); ++i)
    visit(static_cast<std::uint32_t>(i / 4), joints->values[i], weights->values[i]);
  return true;
}

bool read_keys(const GltfDocument& document, const SortedJson& sampler, rig::Keys<rig::Vec3>& keys) {
  return read(document, sampler, 3, keys);
}

bool read_keys(const GltfDocument& document, const SortedJson& sampler, rig::Keys<rig::Quaternion>& keys) {
  return read(document, sampler, 4, keys);
}

}  // namespace bodice::io
