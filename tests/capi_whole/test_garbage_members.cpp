// Structures of libbodice with valid heads and garbage in their members: each call has a status with a
// sentence, and ends. Pointers are null or have as much memory as the structure states.
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <bodice/engine/random.hpp>

#include "capi_whole/dressed.hpp"

using namespace capi_test;
using namespace bodice;

namespace {

/// Draws members, most of which are as they should be, so that what is behind the first check is reached.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  bool rarely() { return random_.below(6) == 0; }
  std::int32_t whole(std::int32_t as_it_should_be) {
    static constexpr std::int32_t kOdd[] = {0,
                                            1,
                                            2,
                                            3,
                                            4,
                                            7,
                                            100,
                                            65536,
                                            -1,
                                            -2,
                                            std::numeric_limits<std::int32_t>::max(),
                                            std::numeric_limits<std::int32_t>::min()};
    return rarely() ? kOdd[random_.below(std::size(kOdd))] : as_it_should_be;
  }
  double real(double as_it_should_be) {
    static constexpr double kOdd[] = {0.0,
                                      -0.0,
                                      -1.0,
                                      1e-300,
                                      1e-9,
                                      0.001,
                                      0.05,
                                      1.0,
                                      1e300,
                                      std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::quiet_NaN()};
    return rarely() ? kOdd[random_.below(std::size(kOdd))] : as_it_should_be;
  }
  template <class T>
  T* pointer(T* as_it_should_be) {
    return rarely() ? nullptr : as_it_should_be;
  }
  std::size_t below(std::size_t bound) { return random_.below(bound); }

 private:
  engine::Random random_;
};

void check(bodice_status status) {
  CHECK(status >= BODICE_OK);
  CHECK(status <= BODICE_VERSION_MISMATCH);
  CHECK(status != BODICE_INTERNAL);
  if (status != BODICE_OK) CHECK(std::strlen(bodice_last_error()) > 10);
}

// Calls of a progress are a matter of time, and sanitizers take ten times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kCallsUntilCanceled = 60;
#else
constexpr int kCallsUntilCanceled = 10;
#endif

/// Cancels work that has gone on for a while: garbage may want a million frames.
struct Patience {
  int left = kCallsUntilCanceled;
  static std::int32_t ask(void* host, const char*) { return --static_cast<Patience*>(host)->left < 0; }
};

/// A box of 8 vertices, some of which are odd.
struct Box {
  std::array<double, 24> xyz;
  std::array<std::uint32_t, 36> triangle{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  explicit Box(Draw& draw) {
    static constexpr double kHalf[3] = {0.2, 0.3, 0.1};
    for (std::size_t i = 0; i < xyz.size(); ++i) {
      const double corner = ((i / 3) >> (i % 3)) % 2 ? kHalf[i % 3] : -kHalf[i % 3];
      xyz[i] = draw.below(40) == 0 ? draw.real(corner) : corner;
    }
    if (draw.rarely()) triangle[draw.below(36)] = static_cast<std::uint32_t>(draw.whole(3));
  }
  bodice_mesh mesh(Draw& draw) {
    bodice_mesh mesh = bodice_default_mesh();
    mesh.position = {draw.pointer(xyz.data()), nullptr, nullptr, 0, BODICE_DOUBLE, 0};
    if (draw.rarely()) mesh.position.scalar = draw.whole(BODICE_DOUBLE);
    if (draw.rarely()) mesh.position.y = mesh.position.x;
    mesh.vertices = draw.rarely() ? draw.below(9) : 8;
    mesh.index = draw.pointer(triangle.data());
    mesh.triangles = draw.rarely() ? draw.below(13) : 12;
    mesh.index_bytes = draw.below(20) == 0 ? draw.whole(4) : mesh.index_bytes;
    return mesh;
  }
};

}  // namespace

TEST_CASE("capi: garbage in meshes, options of skins and options of fits ends in a status") {
  const Context context = make_context(1);
  int skins = 0, proxies = 0;
  for (std::uint64_t round = 0; round < 150; ++round) {
    Draw draw(round);
    Box box(draw);
    const bodice_mesh mesh = box.mesh(draw);
    Patience patience;
    bodice_skin_options options = bodice_default_skin_options();
    // A person is looked for in half a second, which is seldom worth it here.
    options.shape = draw.below(4) == 0 ? draw.whole(BODICE_SHAPE_ANY) : BODICE_SHAPE_ANY;
    options.find_rig = draw.below(20) == 0 ? draw.whole(0) : 0;
    options.progress = draw.pointer(Patience::ask);
    options.host = &patience;
    bodice_skin* skin = nullptr;
    check(bodice_skin_from_mesh(context.get(), &mesh, round == 7 ? nullptr : &options, &skin));
    if (!skin) continue;
    ++skins;
    bodice_fit_options fit = bodice_default_fit_options();
    fit.tier = draw.whole(BODICE_SOLID);
    fit.max_ellipsoids = draw.whole(8);
    if (draw.rarely()) fit.target_error_m = draw.real(0.01);
    if (draw.rarely()) fit.budget_us = draw.real(100.0);
    if (draw.rarely()) fit.time_budget_s = draw.real(0.01);
    fit.covering = draw.whole(0);
    fit.bind = draw.whole(1);
    fit.progress = Patience::ask;
    fit.host = &patience;
    patience.left = kCallsUntilCanceled;
    bodice_proxy* proxy = nullptr;
    bodice_fit_report report = bodice_default_fit_report();
    CAPTURE(round);
    check(bodice_fit(context.get(), skin, &fit, &proxy, draw.pointer(&report)));
    proxies += proxy != nullptr;
    bodice_proxy_destroy(proxy);
    bodice_skin_destroy(skin);
  }
  CHECK(skins > 30);
  CHECK(proxies > 15);
}

TEST_CASE("capi: garbage in rigs ends in a status") {
  const Context context = make_context(1);
  MeshArrays arrays(make_body(2000).mesh);
  const bodice_mesh mesh = arrays.mesh();
  constexpr std::size_t kMostJoints = 4, kMostWeights = 4;
  const std::size_t vertices = mesh.vertices;
  int refused = 0, odd = 0;
  for (std::uint64_t round = 0; round < 300; ++round) {
    Draw draw(round);
    std::array<double, 12 * kMostJoints> matrix{};
    for (std::size_t i = 0; i < matrix.size(); ++i) matrix[i] = i % 12 % 5 == 0 ? 1.0 : 0.0;
    if (draw.rarely()) matrix[draw.below(matrix.size())] = draw.real(0.0);
    bodice_pose bind = bodice_default_pose();
    bind.matrices = draw.pointer(matrix.data());
    bind.scalar = draw.whole(BODICE_DOUBLE);
    bind.count = draw.rarely() ? static_cast<std::uint32_t>(draw.whole(1)) : 1 + draw.below(3);
    std::array<std::int32_t, kMostJoints> parents{-1, 0, 1, 1};
    if (draw.rarely()) parents[draw.below(parents.size())] = draw.whole(0);
    const char* const names[kMostJoints] = {"a", nullptr, "", "\xff\xfe"};
    std::vector<std::uint16_t> joint(vertices * kMostWeights);
    std::vector<float> weight(vertices * kMostWeights, 0.25f);
    if (draw.rarely()) joint[draw.below(joint.size())] = static_cast<std::uint16_t>(draw.whole(1));
    if (draw.rarely()) weight[draw.below(weight.size())] = static_cast<float>(draw.real(0.0));
    bodice_rig rig = bodice_default_rig();
    rig.bind = draw.pointer(&bind);
    rig.names = draw.rarely() && bind.count <= kMostJoints ? names : nullptr;
    rig.parents = bind.count <= kMostJoints ? draw.pointer(parents.data()) : nullptr;
    rig.vertices = draw.rarely() ? draw.below(vertices) : vertices;
    rig.joint = draw.pointer(joint.data());
    rig.weight = draw.pointer(weight.data());
    rig.joints_per_vertex =
        draw.rarely() ? static_cast<std::uint32_t>(draw.below(kMostWeights + 1)) : kMostWeights;
    bool is_odd = false;  // in what only a check of each element finds
    for (std::uint32_t j = 0; rig.parents && j < bind.count; ++j)
      is_odd |= parents[j] < -1 || parents[j] >= static_cast<std::int32_t>(j);
    for (std::size_t i = 0; i < vertices * rig.joints_per_vertex; ++i)
      is_odd |= weight[i] != 0.0f && (!(weight[i] > 0.0f) || std::isinf(weight[i]) || joint[i] >= bind.count);
    // What is behind the checks takes half a second a body, so that most are canceled there.
    Patience patience{.left = round % 75 == 0 ? 1000 : 0};
    bodice_skin_options options = bodice_default_skin_options();
    options.rig = &rig;
    options.progress = Patience::ask;
    options.host = &patience;
    bodice_skin* skin = nullptr;
    CAPTURE(round);
    const bodice_status status = bodice_skin_from_mesh(context.get(), &mesh, &options, &skin);
    check(status);
    bodice_skin_destroy(skin);
    refused += status == BODICE_INVALID_ARGUMENT;
    odd += is_odd;
    if (is_odd)
      CHECK(status == BODICE_INVALID_ARGUMENT);
    else if (patience.left < 0)
      CHECK(status == BODICE_CANCELED);
  }
  CHECK(odd > 20);
  CHECK(refused > 100);
  CHECK(refused < 300);
}

TEST_CASE("capi: garbage in garments, options of sessions and options of drapes ends in a status") {
  const Context context = make_context(1);
  const Dressed dressed;
  MeshArrays body(dressed.body.mesh), cloth(dressed.skirt.mesh);
  const Skin skin = make_skin(context, body);
  bodice_proxy* proxy = nullptr;
  const bodice_fit_options solid_fit = solid();
  must(bodice_fit(context.get(), skin.get(), &solid_fit, &proxy, nullptr));
  const bodice_mesh good = cloth.mesh();
  static constexpr const char* kNames[] = {"denim", "", "no such fabric", "\xff\xfe"};
  int drapes = 0;
  for (std::uint64_t round = 0; round < 60; ++round) {
    Draw draw(round);
    CAPTURE(round);
    Box box(draw);
    const bodice_mesh boxed = box.mesh(draw);
    const bool is_box = draw.below(2) == 0;
    bodice_garment garment = dressed.garment(is_box ? boxed : good);
    garment.mesh = draw.pointer(garment.mesh);
    if (draw.rarely()) garment.name = kNames[draw.below(std::size(kNames))];
    std::vector<std::uint32_t> held(garment.held, garment.held + garment.held_count);
    const bool is_odd = draw.rarely();
    if (is_odd) held[draw.below(held.size())] = static_cast<std::uint32_t>(-1 - draw.whole(0) % 2);
    garment.held = is_box ? nullptr : draw.pointer(held.data());
    garment.held_count = is_box ? draw.below(2) : held.size();

    bodice_session_options session = bodice_default_session_options();
    session.tier = draw.whole(BODICE_SOLID);
    session.max_ellipsoids = draw.whole(20);
    session.moves = draw.whole(0);
    session.substeps = draw.whole(2);
    session.fabric = draw.rarely() ? kNames[draw.below(std::size(kNames))] : nullptr;
    session.thickness_m = draw.real(0.001);
    bodice_session* made = nullptr;
    check(bodice_session_create(context.get(), &session, &made));
    if (made) {
      const bodice_status dressed_status = bodice_session_dress(made, &garment, 1);
      check(dressed_status);
      if (is_odd && !is_box) CHECK(dressed_status == BODICE_INVALID_ARGUMENT);
      check(bodice_session_step(made, draw.real(0.01), nullptr));  // there is no body yet
      check(bodice_session_seek(made, draw.real(0.0), draw.real(0.0)));
      check(bodice_session_play(made, kNames[draw.below(std::size(kNames))], draw.pointer("x")));
    }
    bodice_session_destroy(made);

    Patience patience;
    bodice_drape_options drape = bodice_default_drape_options();
    drape.frames = draw.whole(1);
    drape.substeps = draw.whole(1);
    drape.dt_s = draw.real(0.01);
    drape.thickness_m = draw.real(0.0);
    drape.fabric = draw.rarely() ? kNames[draw.below(std::size(kNames))] : nullptr;
    drape.motion = draw.below(20) == 0 ? "walk" : nullptr;
    drape.tack_m = draw.real(0.006);
    drape.find_position = draw.whole(0);
    drape.hold = draw.whole(0);
    drape.progress = Patience::ask;
    drape.host = &patience;
    bodice_drape_report report = bodice_default_drape_report();
    const bodice_status status =
        bodice_drape(context.get(), skin.get(), proxy, &garment, 1, &drape, nullptr, draw.pointer(&report));
    check(status);
    drapes += status == BODICE_OK;
  }
  CHECK(drapes > 3);
  bodice_proxy_destroy(proxy);
}
