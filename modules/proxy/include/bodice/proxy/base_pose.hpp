// Base poses: tables of a bound proxy that were solved anew in a pose, because those that are carried there
// from rest err too much; and files that hold a proxy with its base poses.
//
// The tables of a base pose belong to directions at rest, like those of the proxy itself. Hence tables of
// rest and of base poses can be mixed by shares that change with the joints, ellipsoid by ellipsoid: a body
// that sits with its arms up takes the legs of one base pose and the shoulders of another.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::proxy {

/// Plain data. E ellipsoids, J joints, X texels of the bound proxy.
struct BasePose {
  std::string name;                 ///< for people, such as "sit"; may be empty
  std::vector<JointMatrix> joints;  ///< #J: joint space to world in the pose
  std::vector<ReliefTable> relief;  ///< #E: the proxy's tables with other scales and offsets
  std::vector<ReliefTexel> texels;  ///< #X

  /// Bytes in memory: some 120 KB.
  std::size_t bytes() const;
};
using BasePoses = std::vector<std::shared_ptr<const BasePose>>;

/// Whether a base pose has finite joints and tables like this bound proxy's. Fails with kInvalidArgument and
/// names what does not fit. Posing relies on it. O(#E + #J).
engine::Result<void> check_base(const BodyProxy& bound, const BasePose& base);

/// A bound proxy and the poses that it has tables for besides rest.
struct ProxyWithBases {
  BodyProxy proxy;
  BasePoses bases;
};

/// Writes what save() of proxy_file.hpp writes, and the base poses behind it: load() of such a file gives the
/// proxy alone. Fails with kWriteFailed, or as check_base() does.
engine::Result<void> save_with_bases(const ProxyWithBases& both, const std::filesystem::path& file);
/// Reads a proxy and its base poses, none from a file of save(). Fails as load() does, or with kUnreadable
/// where the base poses are damaged or of a version that is not known.
engine::Result<ProxyWithBases> load_with_bases(const std::filesystem::path& file);

}  // namespace bodice::proxy
