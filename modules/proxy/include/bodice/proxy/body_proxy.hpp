// The body proxy, which preprocessing makes and the frame path reads.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/proxy/binding.hpp>

namespace bodice::inline v0_1::proxy {

/// A promise of accuracy, from the paper as written to a fraction of a millimeter; README.md has the numbers.
enum class Tier : std::uint8_t { kPaper, kSolid, kTight, kRelief };

/// The tier's name in files and options: "paper", "solid", "tight" or "relief".
std::string_view name(Tier tier);
/// The tier of a name, if there is one.
std::optional<Tier> tier_from_name(std::string_view text);

/// The bone of an ellipsoid without a binding.
inline constexpr std::int16_t kNoBone = -1;
/// The most ellipsoids, nodes along a side of a relief table, and texels of a proxy.
inline constexpr std::size_t kMaxEllipsoids = 65536;
inline constexpr int kMaxReliefNodes = 1024;
inline constexpr std::size_t kMaxReliefTexels = std::size_t{1} << 26;

/// An ellipsoid of a proxy, and the part and joint that it belongs to.
struct ProxyEllipsoid {
  geometry::Ellipsoid shape;
  body::Part part = body::Part::kHead;
  /// The joint that moves most of its skin, an index into Binding::joint_names; kNoBone without a binding.
  std::int16_t bone = kNoBone;
};

/// A table of corrections to one ellipsoid's distance over the octahedral map of the unit sphere.
/// proxy_distance.hpp defines how it is read. h and a, both lengths, are bilinear between nodes.
struct ReliefTable {
  std::uint16_t nodes_per_side = 0;           ///< N, 2..kMaxReliefNodes; 0: no table
  float h_scale_m = 0.0f, h_offset_m = 0.0f;  ///< h = offset + scale * byte / 255
  float a_scale = 0.0f, a_offset = 0.0f;      ///< a = offset + scale * byte / 255, meters
  std::uint32_t first_texel = 0;              ///< into BodyProxy::texels(), N*N texels, row-major; not
                                              ///< beyond their end without a table either
};

/// A node of a relief table: h and a, quantized to a byte each.
struct ReliefTexel {
  std::uint8_t h = 0;
  std::uint8_t a = 0;
};

/// An immutable union of ellipsoids, with or without relief, that stands for a body. Copies are cheap and
/// thread-safe. Lengths are meters, y is up.
class BodyProxy {
 public:
  /// The numbers of a proxy, not checked yet.
  struct Data {
    Tier tier = Tier::kPaper;
    double stature_m = 0.0;
    double margin_m = 0.0;  ///< taken off every distance by queries (covers what the fit left out)
    std::vector<ProxyEllipsoid> ellipsoids;
    std::vector<ReliefTable> relief;  ///< empty, or one an ellipsoid
    std::vector<ReliefTexel> texels;
    std::uint64_t source_hash = 0;           ///< hash of the mesh that the proxy was fitted to
    geometry::Frame frame;                   ///< unit and axes of the file that the body came from
    std::shared_ptr<const Binding> binding;  ///< to the joints of a rig; null: the proxy stays as it is
  };

  /// Checks every value (finite, radii > 0, axes orthonormal to 1e-6 and right-handed, tables inside texels)
  /// and hashes the geometry. Each number is rounded to 44 significant bits, so that a file in any unit gives
  /// the same bits back. Fails with kInvalidArgument and names the ellipsoid.
  static engine::Result<BodyProxy> make(Data data);

  Tier tier() const { return data_->tier; }
  double stature_m() const { return data_->stature_m; }
  double margin_m() const { return data_->margin_m; }
  std::span<const ProxyEllipsoid> ellipsoids() const { return data_->ellipsoids; }
  std::span<const ReliefTable> relief() const { return data_->relief; }
  std::span<const ReliefTexel> texels() const { return data_->texels; }
  std::uint64_t source_hash() const { return data_->source_hash; }
  const geometry::Frame& frame() const { return data_->frame; }
  /// Null unless the proxy is bound to the joints of a rig. All else of a bound proxy is the proxy at rest.
  const Binding* binding() const { return data_->binding.get(); }
  /// The numbers of the proxy, to make another one of.
  const Data& data() const { return *data_; }
  /// The identity of the geometry (tier, sizes, ellipsoids, tables), without frame and source. Equal bits
  /// have equal hashes.
  std::uint64_t hash() const { return hash_; }
  /// The size of the shape as stored for queries, in bytes: 15 floats an ellipsoid, and the tables.
  std::size_t bytes() const;

 private:
  explicit BodyProxy(std::shared_ptr<const Data> data);
  std::shared_ptr<const Data> data_;  // shared, so that a copy is two words
  std::uint64_t hash_ = 0;
};

}  // namespace bodice::proxy
