// Structures of garbage and null handles: a status and a sentence, and nothing is made.
#include <cstring>

#include <bodice/engine/random.hpp>

#include "capi_whole/body.hpp"

using namespace capi_test;
using namespace bodice;

namespace {

bool is_refusal(bodice_status status) {
  return status == BODICE_INVALID_ARGUMENT || status == BODICE_NOT_INITIALIZED ||
         status == BODICE_VERSION_MISMATCH;
}

/// Calls `use` with null, with zeros, and with structures of random bytes.
template <class T, class Use>
void with_garbage(std::uint64_t seed, Use use) {
  engine::Random random(seed);
  T structure;
  CHECK(is_refusal(use(static_cast<T*>(nullptr))));
  std::memset(&structure, 0, sizeof structure);
  CHECK(use(&structure) == BODICE_NOT_INITIALIZED);
  for (int round = 0; round < 500; ++round) {
    for (std::size_t i = 0; i < sizeof structure; ++i)
      reinterpret_cast<unsigned char*>(&structure)[i] = static_cast<unsigned char>(random.below(256));
    CHECK(is_refusal(use(&structure)));
  }
}

}  // namespace

TEST_CASE("capi: garbage is refused by every structure of libbodice") {
  const Context context = make_context(1);
  MeshArrays arrays(make_body(2000).mesh);
  const bodice_mesh mesh = arrays.mesh();
  const Skin skin = make_skin(context, arrays);
  auto session = Session::create(context);
  REQUIRE(session);
  bodice_skin* made_skin = nullptr;
  bodice_proxy* made_proxy = nullptr;
  bodice_session* made_session = nullptr;
  bodice_ticket* ticket = nullptr;

  with_garbage<bodice_mesh>(1, [&](const bodice_mesh* garbage) {
    return bodice_skin_from_mesh(context.get(), garbage, nullptr, &made_skin);
  });
  const auto unless_null = [](auto use) {  // null stands for the defaults
    return [use](const auto* garbage) { return garbage ? use(garbage) : BODICE_INVALID_ARGUMENT; };
  };
  with_garbage<bodice_skin_options>(2, unless_null([&](const bodice_skin_options* garbage) {
                                      return bodice_skin_from_mesh(context.get(), &mesh, garbage, &made_skin);
                                    }));
  with_garbage<bodice_rig>(3, unless_null([&](const bodice_rig* garbage) {
                             bodice_skin_options options = bodice_default_skin_options();
                             options.rig = garbage;
                             return bodice_skin_from_mesh(context.get(), &mesh, &options, &made_skin);
                           }));
  with_garbage<bodice_fit_options>(4, unless_null([&](const bodice_fit_options* garbage) {
                                     return bodice_fit(context.get(), skin.get(), garbage, &made_proxy,
                                                       nullptr);
                                   }));
  with_garbage<bodice_fit_options>(5, unless_null([&](const bodice_fit_options* garbage) {
                                     return bodice_fit_begin(context.get(), &mesh, nullptr, garbage, &ticket);
                                   }));
  with_garbage<bodice_session_options>(6, unless_null([&](const bodice_session_options* garbage) {
                                         return bodice_session_create(context.get(), garbage, &made_session);
                                       }));
  with_garbage<bodice_garment>(
      7, [&](const bodice_garment* garbage) { return bodice_session_dress(session->get(), garbage, 1); });
  with_garbage<bodice_skin_info>(
      8, [&](bodice_skin_info* garbage) { return bodice_skin_get_info(skin.get(), garbage); });
  CHECK(made_skin == nullptr);
  CHECK(made_proxy == nullptr);
  CHECK(made_session == nullptr);
  CHECK(ticket == nullptr);
}

TEST_CASE("capi: null handles are refused, and released without harm") {
  bodice_skin* skin = nullptr;
  bodice_proxy* proxy = nullptr;
  bodice_session* session = nullptr;
  bodice_ticket* ticket = nullptr;
  std::int32_t number = 0;
  std::uint64_t hash = 0;
  CHECK(bodice_skin_from_mesh(nullptr, nullptr, nullptr, &skin) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_skin_from_file(nullptr, "x", nullptr, &skin) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_skin_built_in(nullptr, 1, 1.7, nullptr, nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_skin_get_info(nullptr, nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_skin_get_mesh(nullptr, nullptr, 0, nullptr, 0) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_skin_get_parts(nullptr, nullptr, 0) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_skin_get_vertex_of_input(nullptr, nullptr, 0) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_skin_get_landmarks(nullptr, nullptr, 0) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_skin_get_measurements(nullptr, nullptr, 0) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_skin_warning(nullptr, 0) == nullptr);
  CHECK(bodice_skin_joint_name(nullptr, 0) == nullptr);
  CHECK(bodice_skin_joint_parent(nullptr, 0) == -1);
  CHECK(bodice_fit(nullptr, nullptr, nullptr, &proxy, nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_fit_begin(nullptr, nullptr, nullptr, nullptr, &ticket) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_ticket_poll(nullptr, &number) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_ticket_cancel(nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_ticket_take(nullptr, nullptr, &proxy, nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_create(nullptr, nullptr, &session) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_submit(nullptr, nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_submit_file(nullptr, "x") == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_poll(nullptr, &number) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_dress(nullptr, nullptr, 0) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_play(nullptr, "walk", nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_pause(nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_resume(nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_seek(nullptr, 0.0, 0.0) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_step(nullptr, 0.0, nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_get_positions(nullptr, nullptr, 0) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_get_proxy(nullptr, &proxy) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_get_hash(nullptr, &hash) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_drape(nullptr, nullptr, nullptr, nullptr, 0, nullptr, nullptr, nullptr) ==
        BODICE_INVALID_ARGUMENT);
  bodice_skin_destroy(nullptr);
  bodice_ticket_destroy(nullptr);
  bodice_session_destroy(nullptr);
}
