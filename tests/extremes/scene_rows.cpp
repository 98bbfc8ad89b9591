// Unions of ellipsoids that no fit makes, plain and with tables.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <Eigen/Geometry>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/proxy/proxy_distance.hpp>
#include <bodice_test/responses.hpp>

#include "rows.hpp"

namespace extremes {
namespace {

using namespace bodice;
using bodice_test::leaves_none_inside;
using geometry::Ellipsoid;
using geometry::Vec3;

constexpr std::size_t kRandomPoints = 600;

struct Union {
  std::string name;
  std::vector<Ellipsoid> shapes;
  double size_m = 1.0;  ///< half the side of the cube that holds the particles
  double stature_m = 1.7;
  bool relief = false;
};

Vec3 in_cube(engine::Random& random, double half_m) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = random.uniform(-half_m, half_m);
  return p;
}

std::vector<Ellipsoid> scattered(std::size_t count, double size_m, double least_m, double largest_m) {
  engine::Random random(count);
  std::vector<Ellipsoid> shapes(count);
  for (Ellipsoid& e : shapes) {
    e.center = in_cube(random, 0.6 * size_m);
    const Vec3 axis = in_cube(random, 1.0).normalized();
    e.axes = Eigen::AngleAxisd(random.uniform(0.0, 3.0), axis).toRotationMatrix();
    for (int k = 0; k < 3; ++k) e.radii[k] = least_m * std::pow(largest_m / least_m, random.uniform());
  }
  return shapes;
}

std::vector<Ellipsoid> nested() {
  std::vector<Ellipsoid> shapes(6, scattered(1, 0.1, 0.3, 0.6)[0]);
  for (std::size_t k = 0; k < shapes.size(); ++k) shapes[k].radii *= 1.0 - 0.15 * static_cast<double>(k);
  return shapes;
}

std::vector<Ellipsoid> tangent(bool inside) {
  std::vector<Ellipsoid> shapes(2);
  shapes[0].radii.setConstant(0.5);
  shapes[1].radii.setConstant(inside ? 0.25 : 0.5);
  shapes[1].center.x() = inside ? 0.25 : 1.0;
  return shapes;
}

std::vector<Ellipsoid> moved(std::vector<Ellipsoid> shapes, double scale, const Vec3& offset_m) {
  for (Ellipsoid& e : shapes) e = {scale * e.center + offset_m, e.axes, scale * e.radii};
  return shapes;
}

std::vector<Union> make_unions() {
  const auto few = scattered(20, 1.0, 0.05, 0.4);
  std::vector<Union> unions = {{"no ellipsoid", {}},
                               {"one ellipsoid", scattered(1, 0.1, 0.2, 0.6)},
                               {"identical, 64", std::vector<Ellipsoid>(64, few[0])},
                               {"nested", nested()},
                               {"tangent from outside", tangent(false)},
                               {"tangent from inside", tangent(true)},
                               {"4,096 apart", scattered(4096, 1.0, 0.005, 0.05)},
                               {"radii 1e-6 to 1 m", scattered(100, 1.0, 1e-6, 1.0)},
                               {"radii 1 m to 1e6 m", scattered(100, 1e6, 1.0, 1e6), 1e6}};
  for (const bool relief : {false, true}) {
    const std::string with = relief ? ", relief" : "";
    for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6})
      unions.push_back({"20 at scale " + std::to_string(scale) + with, moved(few, scale, Vec3::Zero()), scale,
                        1.7 * scale, relief});
    unions.push_back({"20, 10 km away" + with, moved(few, 1.0, Vec3(6e3, -6.4e3, 4.8e3)), 1.0, 1.7, relief});
  }
  return unions;
}

const std::vector<Union>& unions() {
  static const std::vector<Union> all = make_unions();
  return all;
}

/// Adds tables of three by three nodes, of which the four corners are one direction.
void add_relief(proxy::BodyProxy::Data& data) {
  engine::Random random(5);
  for (std::size_t k = 0; k < data.ellipsoids.size(); ++k) {
    const auto height_m = static_cast<float>(0.003 * data.stature_m);
    data.relief.push_back({3, 2.0f * height_m, -height_m, 2.0f * height_m, -height_m,
                           static_cast<std::uint32_t>(data.texels.size())});
    proxy::ReliefTexel texels[9];
    for (auto& t : texels)
      t = {static_cast<std::uint8_t>(random.below(256)), static_cast<std::uint8_t>(random.below(256))};
    texels[2] = texels[6] = texels[8] = texels[0];
    data.texels.insert(data.texels.end(), std::begin(texels), std::end(texels));
  }
}

proxy::BodyProxy proxy_of(const Union& u) {
  proxy::BodyProxy::Data data;
  data.tier = u.relief ? proxy::Tier::kRelief : proxy::Tier::kTight;
  data.stature_m = u.stature_m;
  for (const Ellipsoid& e : u.shapes) data.ellipsoids.push_back({e});
  if (u.relief) add_relief(data);
  return proxy::BodyProxy::make(std::move(data)).value();
}

/// Random points, every center, and each of them twice; NaN and Inf at the third and fourth position.
struct UnionCloud {
  std::vector<float> x, y, z, vx, vy, vz;

  UnionCloud(const Union& u, const Vec3& origin) {
    engine::Random random(9);
    const Vec3 middle = u.shapes.empty() ? Vec3(Vec3::Zero()) : u.shapes[0].center;
    for (std::size_t i = 0; i < kRandomPoints; ++i) add(middle + in_cube(random, u.size_m) - origin);
    for (std::size_t k = 0; k < std::min<std::size_t>(u.shapes.size(), 100); ++k)
      for (int copy = 0; copy < 2; ++copy) add(u.shapes[k].center - origin);
    x[2] = std::numeric_limits<float>::quiet_NaN();
    y[3] = std::numeric_limits<float>::infinity();
  }
  void add(const Vec3& local) {
    const Eigen::Vector3f p = local.cast<float>();
    x.push_back(p.x()), y.push_back(p.y()), z.push_back(p.z());
    for (auto* v : {&vx, &vy, &vz}) v->push_back(1.0f);
  }
  collision::Particles particles() {
    return {x.size(), x.data(), y.data(), z.data(), vx.data(), vy.data(), vz.data()};
  }
  Vec3 at(std::size_t i, const Vec3& origin) const {
    return origin + Vec3(double{x[i]}, double{y[i]}, double{z[i]});
  }
};

/// The resolution of floats at these coordinates; where owners blend, an error counts eightfold.
double tolerance_m(const Union& u) {
  double longest = u.size_m;
  for (const Ellipsoid& e : u.shapes) longest = std::max(longest, e.radii.maxCoeff());
  return (u.relief ? 1.6e-5 : 2e-6) * (longest + 2.0 * u.size_m);
}

/// Checks that a contact distance selects contacts and changes none.
std::string check_within(const collision::Collider& collider, UnionCloud& cloud,
                         const std::vector<collision::Contact>& all) {
  std::vector<float> distances;
  for (const collision::Contact& c : all) distances.push_back(c.signed_distance);
  std::sort(distances.begin(), distances.end());
  std::vector<collision::Contact> found(all.size());
  for (const float within_m : {0.0f, distances[distances.size() / 3], distances[distances.size() / 2]}) {
    collider.query({}, cloud.particles(), found, {.within_m = within_m});
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool within = all[i].signed_distance <= within_m && all[i].ellipsoid != collision::kNoEllipsoid;
      if ((found[i].ellipsoid != collision::kNoEllipsoid) != within) return "contacts of the wrong particles";
      if (within && std::memcmp(&found[i], &all[i], sizeof(all[i])) != 0)
        return "a contact distance changes contacts";
    }
  }
  return {};
}

std::string check_query(const Union& u) {
  const auto proxy = proxy_of(u);
  const collision::Collider collider(proxy);
  UnionCloud cloud(u, collider.origin());
  std::vector<collision::Contact> contacts(cloud.x.size());
  collider.query({}, cloud.particles(), contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const bool nothing = u.shapes.empty() || i == 2 || i == 3;
    if ((contacts[i].ellipsoid == collision::kNoEllipsoid) != nothing) return "an ellipsoid where none is";
    if (nothing) continue;
    if (!std::isfinite(contacts[i].signed_distance)) return "not finite";
    if (u.relief && i >= kRandomPoints) continue;  // at a center, rounding decides where a table is read
    const double truth = proxy::proxy_distance(proxy, cloud.at(i, collider.origin())).distance;
    const double error = std::abs(double{contacts[i].signed_distance} - truth);
    if (!(error <= tolerance_m(u))) return "distance off by " + std::to_string(error / u.size_m) + " sizes";
    const collision::Contact one = collider.query({cloud.x[i], cloud.y[i], cloud.z[i]});
    if (!(std::abs(double{one.signed_distance} - truth) <= tolerance_m(u))) return "a single query disagrees";
  }
  return check_within(collider, cloud, contacts);
}

/// Checks that contacts to first order are on the right side, and for plain ellipsoids not beyond their
/// owner.
std::string check_first_order(const Union& u) {
  const auto proxy = proxy_of(u);
  const collision::Collider collider(proxy);
  UnionCloud cloud(u, collider.origin());
  std::vector<collision::Contact> contacts(cloud.x.size());
  collider.query({}, cloud.particles(), contacts, {.accuracy = collision::Accuracy::kFirstOrder});
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const collision::Contact& c = contacts[i];
    const bool nothing = u.shapes.empty() || i == 2 || i == 3;
    if ((c.ellipsoid == collision::kNoEllipsoid) != nothing) return "an ellipsoid where none is";
    if (nothing) continue;
    const Vec3 normal(double{c.normal[0]}, double{c.normal[1]}, double{c.normal[2]});
    if (!std::isfinite(c.signed_distance + c.point[0] + c.point[1] + c.point[2])) return "not finite";
    if (!(std::abs(normal.norm() - 1.0) < 1e-5)) return "a normal that is not unit";
    if (u.relief) continue;
    const Vec3 p = cloud.at(i, collider.origin());
    const double truth = proxy::proxy_distance(proxy, p).distance, found = double{c.signed_distance};
    if (std::abs(truth) > tolerance_m(u) && (found < 0.0) != (truth < 0.0)) return "the wrong side";
    const double of_named = geometry::closest_point(proxy.ellipsoids()[c.ellipsoid].shape, p).signed_distance;
    if (!(found <= of_named + tolerance_m(u)))
      return "beyond its ellipsoid by " + std::to_string((found - of_named) / u.size_m) + " sizes";
  }
  return {};
}

std::string check_resolve(const Union& u, collision::Response response, double dt_s) {
  const auto proxy = proxy_of(u);
  collision::Collider collider(proxy);
  std::vector<Ellipsoid> shapes;
  for (const auto& e : proxy.ellipsoids()) shapes.push_back(e.shape);
  if (dt_s >= 0.0) collider.move_to(shapes, dt_s);
  UnionCloud cloud(u, collider.origin());
  const auto report = collider.resolve({}, cloud.particles(), {.response = response});
  if (u.shapes.empty()) return expect(report.contacts == 0, "contacts without ellipsoids");
  if (report.not_finite != 2) return "counted " + std::to_string(report.not_finite) + " as not finite";
  if (leaves_none_inside(response) && report.unresolved != 0) return "unresolved";
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    if (i == 2 || i == 3) continue;
    const Vec3 p = cloud.at(i, collider.origin());
    if (!p.allFinite() || !std::isfinite(cloud.vx[i] + cloud.vy[i] + cloud.vz[i])) return "not finite";
    if (!leaves_none_inside(response)) continue;
    const double depth = -proxy::proxy_distance(proxy, p).distance;
    if (depth > tolerance_m(u)) return "still inside by " + std::to_string(depth / u.size_m) + " sizes";
  }
  return {};
}

std::string check_one(const Union& u) {
  const collision::Collider collider(proxy_of(u));
  const auto none = collider.resolve({}, collision::Particles{}, {});
  if (none.contacts != 0 || none.not_finite != 0) return "contacts of no particle";
  UnionCloud cloud(u, collider.origin());
  auto one = cloud.particles();
  one.count = 1;
  const auto report = collider.resolve({}, one, {});
  return expect(report.contacts <= 1 && report.unresolved == 0 && std::isfinite(cloud.x[0]),
                "one went wrong");
}

}  // namespace

std::vector<Row> scene_rows() {
  using collision::Response;
  std::vector<Row> rows;
  for (const Union& u : unions()) {
    rows.push_back({"Collider::query", u.name, [&u] { return check_query(u); }});
    rows.push_back({"Collider::query, to first order", u.name, [&u] { return check_first_order(u); }});
    rows.push_back({"Collider, 0 and 1 particle", u.name, [&u] { return check_one(u); }});
    for (const auto& [name, response] : bodice_test::kResponses)
      rows.push_back({std::string("Collider::resolve, ") + name, u.name,
                      [&u, response] { return check_resolve(u, response, -1.0); }});
    for (const double dt_s : {0.0, 1.0})
      rows.push_back({"move_to and resolve, dt " + std::to_string(dt_s) + " s", u.name,
                      [&u, dt_s] { return check_resolve(u, Response::kClosestPoint, dt_s); }});
  }
  return rows;
}

}  // namespace extremes
