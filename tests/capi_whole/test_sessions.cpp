// Sessions and drapes: two worlds on two threads, and the bits of C++.
#include <cmath>
#include <thread>

#include <bodice/tryon/drape.hpp>

#include "capi_whole/dressed.hpp"

using namespace capi_test;
using namespace bodice;

namespace {

/// Runs a session of its own context to the end of its preparation and thirty steps on; the hash of its
/// cloth.
std::uint64_t run_world(const Dressed& dressed) {
  const Context context = make_context(1);
  bodice_session_options options = bodice_default_session_options();
  options.tier = BODICE_SOLID;
  auto session = Session::create(context, options);
  REQUIRE_MESSAGE(session, bodice_last_error());
  MeshArrays body(dressed.body.mesh), skirt(dressed.skirt.mesh);
  std::int32_t state = BODICE_READY;
  must(bodice_session_poll(session->get(), &state));
  CHECK(state == BODICE_IDLE);
  bodice_proxy* none = nullptr;
  CHECK(bodice_session_get_proxy(session->get(), &none) == BODICE_NOT_FOUND);
  const bodice_mesh mesh = skirt.mesh();
  const bodice_garment worn = dressed.garment(mesh);
  must(session->submit(body.mesh()));
  must(session->dress(&worn, 1));
  int after = 0;
  for (int step = 0; step < 2000 && after < 30; ++step) {
    const auto report = session->step(1.0 / 60.0);
    REQUIRE_MESSAGE(report, bodice_last_error());
    CHECK(report->vertices == dressed.skirt.mesh.positions.size());
    must(bodice_session_poll(session->get(), &state));
    after += state == BODICE_READY && report->has_body;
  }
  CHECK(state == BODICE_READY);
  std::vector<float> xyz(3 * dressed.skirt.mesh.positions.size());
  const bodice_vectors to{xyz.data(), nullptr, nullptr, 0, BODICE_FLOAT, 0};
  must(bodice_session_get_positions(session->get(), &to, xyz.size() / 3));
  bool moved = false;
  for (std::size_t i = 0; i < xyz.size(); ++i) {
    CHECK(std::isfinite(xyz[i]));
    moved = moved || std::abs(xyz[i] - static_cast<float>(skirt.xyz[i])) > 1e-3f;
  }
  CHECK(moved);
  CHECK(bodice_session_get_positions(session->get(), &to, xyz.size()) == BODICE_INVALID_ARGUMENT);
  std::uint64_t hash = 0;
  must(bodice_session_get_hash(session->get(), &hash));
  must(bodice_session_get_proxy(session->get(), &none));
  CHECK(hash_of(Proxy(none).get()) != 0);
  return hash;
}

}  // namespace

TEST_CASE("capi: two worlds on two threads end as one alone does") {
  const Dressed dressed;
  const std::uint64_t alone = run_world(dressed);
  std::uint64_t hashes[2] = {};
  std::thread other([&] { hashes[1] = run_world(dressed); });
  hashes[0] = run_world(dressed);
  other.join();
  CHECK(hashes[0] == alone);
  CHECK(hashes[1] == alone);
}

TEST_CASE("capi: polling reports a preparation that failed, and frames go on") {
  const Context context = make_context(1);
  auto session = Session::create(context);
  REQUIRE(session);
  must(bodice_session_submit_file(session->get(), "no/such/body.obj"));
  REQUIRE(session->step(1.0 / 60.0));
  std::int32_t state = BODICE_IDLE;
  CHECK(bodice_session_poll(session->get(), &state) == BODICE_NOT_FOUND);
  CHECK(state == BODICE_READY);
  CHECK(session->step(1.0 / 60.0)->has_body == 0);
  CHECK(session->step(std::nan("")).status() == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_play(session->get(), "walk", nullptr) == BODICE_INVALID_ARGUMENT);  // nothing moves
}

TEST_CASE("capi: a drape ends where that of C++ does, whatever the arrays") {
  Dressed dressed;
  const Context context = make_context(2);
  MeshArrays body(dressed.body.mesh), skirt(dressed.skirt.mesh);
  const Skin skin = make_skin(context, body);
  const auto proxy = skin.fit(context, solid());
  REQUIRE(proxy);
  bodice_drape_options options = bodice_default_drape_options();
  options.frames = 10;
  options.fabric = "denim";
  std::vector<double> x(dressed.skirt.mesh.positions.size()), y(x.size()), z(x.size());
  const bodice_vectors to{x.data(), y.data(), z.data(), 0, BODICE_DOUBLE, 0};
  const bodice_mesh mesh = skirt.mesh();
  const bodice_garment worn = dressed.garment(mesh);
  bodice_drape_report report = bodice_default_drape_report();
  must(bodice_drape(context.get(), skin.get(), proxy->get(), &worn, 1, &options, &to, &report));

  const auto same = tryon::fit_proxy({}, dressed.skin, {.tier = proxy::Tier::kSolid});
  REQUIRE(same);
  const auto expected = tryon::drape({}, *same, {{"skirt", dressed.skirt.mesh, dressed.skirt.held}},
                                     {.frames = 10, .fabric = *cloth::find_fabric("denim")});
  REQUIRE(expected);
  CHECK(report.hash == expected->report.hash);
  CHECK(report.thickness_m == expected->report.thickness_m);
  const auto& end = expected->garments[0].frames.back();
  for (std::size_t v = 0; v < end.size(); ++v) CHECK(geometry::Vec3(x[v], y[v], z[v]) == end[v]);

  options.fabric = "chain mail";
  const auto drape = [&](const bodice_garment* garments, std::size_t count) {
    return bodice_drape(context.get(), skin.get(), proxy->get(), garments, count, &options, nullptr, nullptr);
  };
  CHECK(drape(&worn, 1) == BODICE_NOT_FOUND);
  options.fabric = nullptr;
  options.motion = "walk";
  CHECK(drape(&worn, 1) == BODICE_INVALID_ARGUMENT);
  options.motion = nullptr;
  CHECK(drape(&worn, 0) == BODICE_INVALID_ARGUMENT);
  CHECK(drape(nullptr, 1) == BODICE_INVALID_ARGUMENT);
  bodice_garment wrong = worn;
  const std::uint32_t held = 1 << 20;
  wrong.held = &held;
  wrong.held_count = 1;
  CHECK(drape(&wrong, 1) == BODICE_INVALID_ARGUMENT);
  CHECK(std::string(bodice_last_error()).find("skirt") != std::string::npos);
}
