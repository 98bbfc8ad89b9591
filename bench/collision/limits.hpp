// Lower limits on the time of any query: moving its bytes, and one closest point a particle without a choice
// of ellipsoids.
#pragma once

#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/proxy/body_proxy.hpp>

#include "frames.hpp"
#include "rows.hpp"

namespace bench {

/// Particles around the proxy's largest ellipsoid, which is alone.
class Limits {
 public:
  /// `band_m`: largest distance of the particles from its surface, to either side.
  Limits(const bodice::proxy::BodyProxy& proxy, std::size_t particles, double band_m);
  /// Adds rows that refer to this object.
  void add_to(std::vector<Row>& rows);

 private:
  void move_bytes();

  bodice::collision::Collider one_;
  Frames frames_;
  std::vector<bodice::collision::Contact> contacts_;
};

}  // namespace bench
