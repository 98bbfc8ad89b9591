// What no query can be faster than: its bytes, and one closest point a particle with nothing to choose.
#pragma once

#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/proxy/body_proxy.hpp>

#include "frames.hpp"
#include "rows.hpp"

namespace bench {

/// Particles around the proxy's largest ellipsoid, alone.
class Limits {
 public:
  /// `band_m`: how far particles are from its surface, to either side.
  Limits(const bodice::proxy::BodyProxy& proxy, std::size_t particles, double band_m);
  /// The rows refer to this.
  void add_to(std::vector<Row>& rows);

 private:
  void move_bytes();

  bodice::collision::Collider one_;
  Frames frames_;
  std::vector<bodice::collision::Contact> contacts_;
};

}  // namespace bench
