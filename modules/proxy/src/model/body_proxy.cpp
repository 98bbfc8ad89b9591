#include <bodice/proxy/body_proxy.hpp>

#include <bodice/engine/hash.hpp>

#include "binding/binding_bytes.hpp"
#include "model/check.hpp"
#include "model/round44.hpp"

namespace bodice::inline v0_1::proxy {
namespace {

constexpr std::size_t kNumbersPerEllipsoid = 15;  // center, radii, axes

void round_numbers(BodyProxy::Data& data) {
  data.stature_m = round44(data.stature_m);
  data.margin_m = round44(data.margin_m);
  for (ProxyEllipsoid& e : data.ellipsoids) {
    e.shape.center = e.shape.center.unaryExpr(&round44);
    e.shape.axes = e.shape.axes.unaryExpr(&round44);
    e.shape.radii = e.shape.radii.unaryExpr(&round44);
  }
  // Floats have fewer than 44 bits. Only -0 and numbers that vanish in another unit need a change.
  for (ReliefTable& t : data.relief)
    for (float* value : {&t.h_scale_m, &t.h_offset_m, &t.a_scale, &t.a_offset})
      if (std::abs(*value) < 1e-20f) *value = 0.0f;
}

void hash_ellipsoid(engine::Hasher& hasher, const ProxyEllipsoid& e) {
  for (int k = 0; k < 3; ++k) hasher.add(e.shape.center[k]);
  for (int k = 0; k < 9; ++k) hasher.add(e.shape.axes.data()[k]);
  for (int k = 0; k < 3; ++k) hasher.add(e.shape.radii[k]);
  hasher.add(e.part);
  hasher.add(e.bone);
}

std::uint64_t hash_of(const BodyProxy::Data& data) {
  engine::Hasher hasher;
  hasher.add(data.tier);
  hasher.add(data.stature_m);
  hasher.add(data.margin_m);
  hasher.add(data.ellipsoids.size());
  for (const ProxyEllipsoid& e : data.ellipsoids) hash_ellipsoid(hasher, e);
  hasher.add(data.relief.size());
  for (const ReliefTable& t : data.relief) {
    hasher.add(t.nodes_per_side);
    for (float value : {t.h_scale_m, t.h_offset_m, t.a_scale, t.a_offset}) hasher.add(value);
    hasher.add(t.first_texel);
  }
  hasher.add(data.texels.size());
  for (const ReliefTexel& texel : data.texels) hasher.add(texel.h * 256 + texel.a);
  if (data.binding) add_to_hash(hasher, *data.binding);
  return hasher.value();
}

}  // namespace

BodyProxy::BodyProxy(std::shared_ptr<const Data> data) : data_(std::move(data)), hash_(hash_of(*data_)) {}

engine::Result<BodyProxy> BodyProxy::make(Data data) {
  if (std::optional<engine::Error> fault = find_fault(data)) return *std::move(fault);
  round_numbers(data);
  return BodyProxy(std::make_shared<const Data>(std::move(data)));
}

std::size_t BodyProxy::bytes() const {
  return data_->ellipsoids.size() * kNumbersPerEllipsoid * sizeof(float) +
         data_->relief.size() * sizeof(ReliefTable) + data_->texels.size() * sizeof(ReliefTexel);
}

}  // namespace bodice::proxy
