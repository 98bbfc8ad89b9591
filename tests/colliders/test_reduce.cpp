// A reduction is judged by shapes of known truth, and by naive capsules.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <bodice/colliders/formats.hpp>
#include <bodice/colliders/reduce.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/synth/body.hpp>

namespace {

using namespace bodice;
using colliders::PlainShape;
using colliders::ShapeKind;
using geometry::Vec3;

/// The distance by brute force: the nearest of many balls along the axis.
double brute_distance(const PlainShape& shape, const Vec3& point) {
  double least = 1e9;
  for (int i = 0; i <= 20000; ++i) {
    const double t = i / 20000.0;
    const Vec3 center = shape.a + t * (shape.b - shape.a);
    least = std::min(least, (point - center).norm() - shape.radius_a - t * (shape.radius_b - shape.radius_a));
  }
  return least;
}

struct Fitted {
  synth::Body body;
  proxy::BodyProxy proxy;
  colliders::SkinPoints points;
};

Fitted fitted() {
  synth::BodyOptions options;
  options.vertices = 3000;
  auto body = synth::make_body({}, options);
  REQUIRE(body.ok());
  const geometry::MeshDistance distance({}, body->mesh);
  const fitting::LabeledSkin skin{body->mesh, body->part, body->stature_m, {}, &distance};
  fitting::FitOptions fit_options;
  fit_options.tier = proxy::Tier::kSolid;
  auto fit = fitting::fit({}, skin, fit_options);
  REQUIRE(fit.ok());
  colliders::SkinPoints points = colliders::skin_points({}, fit->proxy, body->mesh);
  return {std::move(body).value(), fit->proxy, std::move(points)};
}

/// One capsule a part as games have them: along its axis of greatest extent in y or x, with the mean
/// distance.
double naive_mean_m(const Fitted& f) {
  std::vector<PlainShape> capsules;
  for (int p = 0; p < body::kPartCount; ++p) {
    Vec3 low = Vec3::Constant(1e9), high = -low;
    for (std::size_t v = 0; v < f.body.part.size(); ++v)
      if (static_cast<int>(f.body.part[v]) == p)
        low = low.cwiseMin(f.body.mesh.positions[v]), high = high.cwiseMax(f.body.mesh.positions[v]);
    if (low.x() > high.x()) continue;
    const Vec3 size = high - low, mid = 0.5 * (low + high);
    int longest = 0;
    size.maxCoeff(&longest);
    const double radius = (size.sum() - size[longest]) / 4.0;
    const Vec3 half = std::max(0.0, 0.5 * size[longest] - radius) * Vec3::Unit(longest);
    capsules.push_back({mid - half, mid + half, radius, radius, static_cast<body::Part>(p), -1});
  }
  return colliders::cost_of({}, f.proxy, f.points, capsules).whole.mean_m;
}

}  // namespace

TEST_CASE("The distance to a tapered capsule is that to the nearest of its balls") {
  const PlainShape shapes[] = {{{0, 0, 0}, {0, 1, 0}, 0.2, 0.2},
                               {{0, 0, 0}, {0.3, 1, 0.1}, 0.3, 0.1},
                               {{1, 0, 0}, {1, 0, 0}, 0.5, 0.5},
                               {{0, 0, 0}, {0.1, 0, 0}, 0.5, 0.1}};
  for (const PlainShape& shape : shapes)
    for (double x = -0.9; x < 1.2; x += 0.37)
      for (double y = -0.8; y < 1.9; y += 0.41) {
        const Vec3 point(x, y, 0.21);
        CHECK(colliders::shape_distance(shape, point).distance ==
              doctest::Approx(brute_distance(shape, point)).epsilon(1e-6));
      }
}

TEST_CASE("A bounding ball never rules out a shape that is as near as a distance, and rules out far ones") {
  engine::Random random(7);
  auto anywhere = [&](double most) {
    return Vec3(most * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
  };
  int ruled_out = 0;
  for (int i = 0; i < 20000; ++i) {
    PlainShape shape;
    shape.a = anywhere(1.0), shape.b = shape.a + anywhere(i % 3 == 0 ? 0.0 : 0.4);
    shape.radius_a = random.uniform(0.01, 0.3), shape.radius_b = random.uniform(0.01, 0.3);
    const colliders::BoundingBall ball(shape);
    const Vec3 along_axis = shape.b + (i % 2 ? 1e-9 : 1.0) * (shape.b - shape.a), point = anywhere(2.0);
    for (const Vec3& p : {point, along_axis, shape.a}) {
      const double distance_m = colliders::shape_distance(shape, p).distance;
      CHECK_FALSE(ball.is_farther(p, distance_m));
      CHECK_FALSE(ball.is_farther(p, distance_m + 0.01));
    }
    ruled_out += ball.is_farther(point, 0.1);
  }
  CHECK(ruled_out > 10000);
}

TEST_CASE("A body that is one tapered capsule comes back as it is") {
  const PlainShape truth{{0, 0.3, 0}, {0.05, 1.2, 0.02}, 0.14, 0.08};
  colliders::SkinPoints points;
  const Vec3 axis = truth.b - truth.a;
  for (double t = -0.15; t <= 1.15; t += 0.02)
    for (double angle = 0.0; angle < 6.28; angle += 0.2) {
      // A point of the axis moved outward until it is on the surface.
      const Vec3 out(std::cos(angle), 0.3 * (t - 0.5), std::sin(angle));
      Vec3 p = truth.a + t * axis + 0.1 * out;
      for (int i = 0; i < 30; ++i) {
        const auto near = colliders::shape_distance(truth, p);
        p -= near.distance * near.normal;
      }
      points.position.push_back(p), points.area.push_back(1.0), points.owner.push_back(0);
    }
  proxy::BodyProxy::Data data;
  data.stature_m = 1.5;
  data.ellipsoids.push_back(
      {{Vec3(0, 0.75, 0), geometry::Mat3::Identity(), Vec3(0.1, 0.6, 0.1)}, body::Part::kThighL});
  const auto proxy = proxy::BodyProxy::make(data);
  REQUIRE(proxy.ok());
  const auto shapes = colliders::reduce({}, *proxy, points, ShapeKind::kTaperedCapsule, 1);
  REQUIRE(shapes.ok());
  REQUIRE(shapes->size() == 1);
  CHECK(colliders::cost_of({}, *proxy, points, *shapes).whole.worst_m < 1e-4);
  CHECK(shapes->front().part == body::Part::kThighL);
}

TEST_CASE("A reduced body beats naive capsules, and richer colliders are nearer") {
  const Fitted f = fitted();
  const auto mean_mm = [&](ShapeKind kind, int count) {
    const auto shapes = colliders::reduce({}, f.proxy, f.points, kind, count);
    REQUIRE(shapes.ok());
    CHECK(shapes->size() <= static_cast<std::size_t>(count));
    return 1e3 * colliders::cost_of({}, f.proxy, f.points, *shapes).whole.mean_m;
  };
  const double naive = 1e3 * naive_mean_m(f), same_count = mean_mm(ShapeKind::kCapsule, 15);
  const double capsules = mean_mm(ShapeKind::kCapsule, 32), spheres = mean_mm(ShapeKind::kSphere, 32);
  const double tapered = mean_mm(ShapeKind::kTaperedCapsule, 32);
  MESSAGE("mean mm: naive " << naive << ", 15 capsules " << same_count << ", 32 capsules " << capsules
                            << ", tapered " << tapered << ", spheres " << spheres);
  CHECK(same_count < 0.7 * naive);
  CHECK(capsules < same_count);
  CHECK(tapered < capsules);
  CHECK(capsules < spheres);
}

TEST_CASE("A request that cannot be met is refused in one sentence") {
  const Fitted f = fitted();
  for (const int count : {0, -3, colliders::kMaxShapes + 1})
    CHECK(colliders::reduce({}, f.proxy, f.points, ShapeKind::kCapsule, count).error().code ==
          engine::ErrorCode::kInvalidArgument);
  CHECK(colliders::reduce({}, f.proxy, {}, ShapeKind::kCapsule, 8).error().code ==
        engine::ErrorCode::kUnusableGeometry);
  CHECK(colliders::text_of(colliders::Format::kVrm, f.proxy, {}).error().code ==
        engine::ErrorCode::kInvalidArgument);
  const PlainShape tapered{{0, 0, 0}, {0, 1, 0}, 0.2, 0.1};
  CHECK(colliders::text_of(colliders::Format::kGodot, f.proxy, {&tapered, 1}).error().code ==
        engine::ErrorCode::kInvalidArgument);
}
