// Things beside a body in a drape: a figure that sits on a chair, and one that sits down on it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <nlohmann/json.hpp>

#include <bodice/binding/poser.hpp>
#include <bodice/proxy/add_things.hpp>
#include <bodice/proxy/posed_proxy.hpp>
#include <bodice/proxy/proxy_distance.hpp>
#include <bodice/synth/thing.hpp>
#include <bodice/tryon/base_pose.hpp>
#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/report.hpp>
#include <bodice/tryon/rigged_body.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/shapes.hpp>

#include "builtin.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr int kVertices = 4500;

tryon::PreparedBody made_prop(const engine::Context& context, const geometry::TriMesh& mesh,
                              const tryon::PreparedBody& body) {
  auto prop = tryon::make_prop(context, mesh, body, {});
  REQUIRE_MESSAGE(prop.ok(), prop.error().sentence());
  return std::move(prop).value();
}

const Vec3 kSeat_m(1.2, 0.45, 0.0);

/// A chair beside the built-in body of a tier, fitted once for all cases.
const tryon::PreparedBody& chair_at_seat(proxy::Tier tier) {
  static std::map<proxy::Tier, tryon::PreparedBody> made;
  const auto known = made.find(tier);
  if (known != made.end()) return known->second;
  return made.emplace(tier, made_prop({}, synth::make_chair(kSeat_m, 0.03), builtin_body(kVertices, tier)))
      .first->second;
}

/// The built-in body, a chair beside it, and both as one proxy.
struct BesideChair {
  const tryon::PreparedBody& body;
  tryon::PreparedBody chair;
  proxy::BodyProxy all;
};

BesideChair make_beside_chair() {
  const tryon::PreparedBody& body = bound_builtin_body(kVertices, proxy::Tier::kRelief);
  tryon::PreparedBody chair = made_prop({}, synth::make_chair({1.5, 0.45, 0.0}, 0.03), body);
  auto all = tryon::with_props(body.fit.proxy, {&chair, 1});
  REQUIRE_MESSAGE(all.ok(), all.error().sentence());
  return {body, std::move(chair), std::move(all).value()};
}

/// The same for every case of this file.
const BesideChair& beside_chair() {
  static const BesideChair made = make_beside_chair();
  return made;
}

/// Makes a level cloth around a point, without pins.
tryon::WornGarment sheet_over(const Vec3& point, double width_m, int cells) {
  geometry::TriMesh sheet = bodice_test::sheet(width_m, width_m, cells, cells);
  for (Vec3& p : sheet.positions) p += point;
  return {.name = "sheet", .mesh = std::move(sheet)};
}

}  // namespace

TEST_CASE("cloth lands on a prop beside the body, and falls through that space without the prop") {
  for (const proxy::Tier tier : {proxy::Tier::kSolid, proxy::Tier::kRelief}) {
    CAPTURE(std::string(proxy::name(tier)));
    const engine::Context context;
    const tryon::PreparedBody& body = builtin_body(kVertices, tier);
    const tryon::PreparedBody& chair = chair_at_seat(tier);
    const tryon::WornGarment cloth = sheet_over(kSeat_m + Vec3(0.0, 0.06, 0.05), 0.3, 20);
    const auto alone = tryon::drape(context, body, {cloth}, {.frames = 40});
    const auto with = tryon::drape(context, body, {cloth}, {.frames = 40, .props = {&chair, 1}});
    REQUIRE(alone.ok());
    REQUIRE_MESSAGE(with.ok(), with.error().sentence());
    double lowest_alone = 1e9, lowest_with = 1e9;
    for (const Vec3& p : alone->garments[0].frames.back()) lowest_alone = std::min(lowest_alone, p.y());
    for (const Vec3& p : with->garments[0].frames.back()) lowest_with = std::min(lowest_with, p.y());
    CHECK(lowest_alone < 0.3);
    CHECK(lowest_with > 0.445);
    CHECK(alone->report.props.empty());
    CHECK_FALSE(alone->proxy.has_value());
    REQUIRE(with->report.props.size() == 1);
    const tryon::PropReport& report = with->report.props[0];
    CHECK(report.over_1mm == 0);
    // Without relief the prop's proxy is off by fractions of a millimeter, which centroids count as pierced.
    if (tier == proxy::Tier::kRelief) CHECK(report.pierced_share == 0.0);
    CHECK(with->report.inside_union == 0);
    CHECK(with->proxy->ellipsoids().size() ==
          body.fit.proxy.ellipsoids().size() + chair.fit.proxy.ellipsoids().size());
    // The report's depth is that of the boards by their formula.
    const synth::Thing boards = synth::make_thing({}, synth::ThingKind::kChair, 0.03);
    double deepest = 0.0;
    for (const Vec3& p : with->garments[0].frames.back())
      deepest = std::max(deepest, -boards.distance(p - Vec3(kSeat_m.x(), 0.0, kSeat_m.z())));
    CHECK(report.end_m == doctest::Approx(deepest).epsilon(1e-6));
    const auto json = nlohmann::json::parse(tryon::report_json(body, &with->report, {}));
    CHECK(json["drape"]["props"][0]["ellipsoids"] == report.ellipsoids);
  }
}

TEST_CASE("a garment that begins inside a prop is refused with the depth") {
  const engine::Context context;
  const tryon::PreparedBody& body = builtin_body(kVertices, proxy::Tier::kSolid);
  const tryon::PreparedBody& chair = chair_at_seat(proxy::Tier::kSolid);
  CHECK(chair.fit.proxy.tier() == proxy::Tier::kTight);
  CHECK(chair.fit.accuracy.gap_m.mean < 0.004);
  const auto through = sheet_over({1.2, 0.43, 0.0}, 0.3, 10);  // in the middle of the seat's 4 cm
  const auto refused = tryon::drape(context, body, {through}, {.frames = 2, .props = {&chair, 1}});
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == engine::ErrorCode::kUnusableGeometry);
  CHECK(refused.error().message.find("20 mm") != std::string::npos);
}

TEST_CASE("a prop changes neither the body's own fit nor cloth that is far from the prop") {
  const engine::Context context;
  const tryon::PreparedBody& body = builtin_body(kVertices, proxy::Tier::kSolid);
  const std::uint64_t hash = body.fit.proxy.hash();
  const tryon::PreparedBody far = made_prop(context, synth::make_chair({4.0, 0.45, 0.0}, 0.03), body);
  const tryon::WornGarment cloth = sheet_over({0.0, 1.75, 0.0}, 0.5, 16);
  const auto alone = tryon::drape(context, body, {cloth}, {.frames = 10});
  const auto with = tryon::drape(context, body, {cloth}, {.frames = 10, .props = {&far, 1}});
  REQUIRE(alone.ok());
  REQUIRE(with.ok());
  CHECK(body.fit.proxy.hash() == hash);
  double apart = 0.0;
  for (std::size_t i = 0; i < cloth.mesh.positions.size(); ++i)
    apart =
        std::max(apart, (alone->garments[0].frames.back()[i] - with->garments[0].frames.back()[i]).norm());
  CHECK(apart < 1e-4);
}

TEST_CASE("a prop stands still while the joints of the body move") {
  const engine::Context context;
  const auto& [body, chair, all] = beside_chair();
  CHECK(all.binding()->joint_names.back() == proxy::kStillJoint);

  auto poser = binding::Poser::make(all), own = binding::Poser::make(body.fit.proxy);
  REQUIRE(poser.ok());
  REQUIRE(own.ok());
  std::vector<rig::Affine> joints(body.fit.proxy.binding()->bind);
  const Vec3 by(0.0, 0.0, -0.4);
  for (rig::Affine& joint : joints) joint.col(3) += by;
  REQUIRE(own->pose(context, joints).ok());
  joints.push_back(rig::identity());
  REQUIRE(poser->pose(context, joints).ok());
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(1.5 + 0.3 * std::sin(1.1 * i), 0.5 + 0.5 * std::sin(1.7 * i), 0.3 * std::sin(2.3 * i));
    CHECK(proxy::posed_proxy_distance(all, poser->posed(), p).distance ==
          doctest::Approx(proxy::proxy_distance(chair.fit.proxy, p).distance).epsilon(1e-9));
    const Vec3 q(0.3 * std::sin(1.1 * i), 0.9 + 0.9 * std::sin(1.7 * i), -0.4 + 0.3 * std::sin(2.3 * i));
    CHECK(
        proxy::posed_proxy_distance(all, poser->posed(), q).distance ==
        doctest::Approx(proxy::posed_proxy_distance(body.fit.proxy, own->posed(), q).distance).epsilon(1e-9));
  }
}

TEST_CASE("with a prop, the body uses its base poses, and the prop keeps its tables") {
  const engine::Context context;
  const auto& [body, chair, all] = beside_chair();
  std::vector<engine::Warning> warnings;
  const auto motion = tryon::find_motion(context, body.skin, {.motion = "squat"}, warnings);
  REQUIRE(motion.ok());
  std::vector<rig::Affine> joints(motion->rig.skeleton.joints.size());
  rig::joint_matrices(motion->rig.skeleton, motion->clip, 1.0, joints);
  const auto base = tryon::make_base_pose(context, body.fit.proxy, body.skin, joints, "squat");
  REQUIRE(base.ok());
  const auto of_all = std::make_shared<const proxy::BasePose>(proxy::with_things(**base, all));
  REQUIRE(proxy::check_base(all, *of_all).ok());

  auto poser = binding::Poser::make(all), own = binding::Poser::make(body.fit.proxy),
       carried = binding::Poser::make(body.fit.proxy);
  REQUIRE(poser->keep_base(of_all).ok());
  REQUIRE(own->keep_base(*base).ok());
  REQUIRE(own->pose(context, joints).ok());
  REQUIRE(carried->pose(context, joints).ok());
  joints.push_back(rig::identity());
  REQUIRE(poser->pose(context, joints).ok());
  double most_m = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(1.5 + 0.3 * std::sin(1.1 * i), 0.5 + 0.5 * std::sin(1.7 * i), 0.3 * std::sin(2.3 * i));
    CHECK(proxy::posed_proxy_distance(all, poser->posed(), p).distance ==
          doctest::Approx(proxy::proxy_distance(chair.fit.proxy, p).distance).epsilon(1e-9));
    const Vec3 q(0.3 * std::sin(1.1 * i), 0.5 + 0.5 * std::sin(1.7 * i), 0.3 * std::sin(2.3 * i));
    const double with_base_m = proxy::posed_proxy_distance(body.fit.proxy, own->posed(), q).distance;
    CHECK(proxy::posed_proxy_distance(all, poser->posed(), q).distance ==
          doctest::Approx(with_base_m).epsilon(1e-9));
    most_m = std::max(
        most_m,
        std::abs(with_base_m - proxy::posed_proxy_distance(body.fit.proxy, carried->posed(), q).distance));
  }
  CHECK(most_m > 1e-3);  // the base pose makes a difference
}
