// The binding of a proxy as bytes: for files and for the hash.
#pragma once

#include <bodice/engine/hash.hpp>
#include <bodice/proxy/binding.hpp>

#include "bytes/bytes.hpp"

namespace bodice::inline v0_1::proxy {

/// Little-endian:
///   u32 #joints, #ellipsoids, #terms, #texels, #bundles, #entries, #followers; f32 burial step
///   joint:      u16 length of the name, the name's bytes, f64 bind[12] by columns
///   ellipsoid:  u32 first term, first bundle, first follower, f32 step           (then the ends of both
///   firsts) term:       u16 joint, f64 matrix[16] by columns texel:      u8 burial bundle:     u16
///   texel[16], i16 position[3][16], i16 direction[2][16], i16 height[16], u32 first entry entry:      u16
///   term, u16 weight[16] follower:   u16 texel
void put_binding(ByteWriter& out, const Binding& binding);

/// Reads what put_binding() wrote; nothing where the counts do not fit the bytes that are left. The values
/// are not checked: BodyProxy::make() does that.
bool get_binding(ByteReader& in, Binding& binding);

void add_to_hash(engine::Hasher& hasher, const Binding& binding);

}  // namespace bodice::proxy
