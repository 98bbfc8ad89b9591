// Skins: what C gets of a made body against the truth about it and against the C++ layers.
#include <cmath>
#include <map>
#include <string>

#include <bodice/anatomy/measure.hpp>
#include <bodice/tryon/prepare.hpp>

#include "capi_whole/body.hpp"

using namespace capi_test;
using namespace bodice;

TEST_CASE("capi: a mesh in memory becomes the skin that C++ makes of it") {
  const synth::Body body = make_body();
  MeshArrays arrays(body.mesh);
  const Context context = make_context();
  const Skin skin = make_skin(context, arrays);
  const auto info = skin.info();
  REQUIRE(info);
  CHECK(info->stature_m == doctest::Approx(1.68).epsilon(0.02));
  CHECK(info->up[1] > 0.99);
  CHECK(info->input_vertices == body.mesh.positions.size());
  CHECK(info->joints == 0);

  auto input = tryon::repair_body({}, body.mesh);
  REQUIRE(input);
  const auto expected = tryon::segment_mesh({}, *input, {});
  REQUIRE(expected);
  const auto& mesh = expected->input.skin;
  REQUIRE(info->vertices == mesh.positions.size());
  REQUIRE(info->triangles == mesh.triangles.size());
  std::vector<double> positions(3 * info->vertices);
  std::vector<std::uint32_t> triangles(3 * info->triangles), vertex(info->input_vertices);
  std::vector<std::uint8_t> part(info->vertices);
  must(bodice_skin_get_mesh(skin.get(), positions.data(), info->vertices, triangles.data(), info->triangles));
  must(bodice_skin_get_parts(skin.get(), part.data(), part.size()));
  must(bodice_skin_get_vertex_of_input(skin.get(), vertex.data(), vertex.size()));
  std::size_t right = 0;
  for (std::size_t i = 0; i < vertex.size(); ++i) {
    REQUIRE(vertex[i] < info->vertices);
    const geometry::Vec3 there(positions[3 * vertex[i]], positions[3 * vertex[i] + 1],
                               positions[3 * vertex[i] + 2]);
    CHECK((there - body.mesh.positions[i]).norm() < 1e-5);
    right += static_cast<body::Part>(part[vertex[i]]) == body.part[i];
  }
  CHECK(static_cast<double>(right) > 0.9 * static_cast<double>(vertex.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) CHECK(triangles[3 * t + 2] == mesh.triangles[t][2]);

  bodice_landmark landmarks[BODICE_LANDMARKS];
  must(bodice_skin_get_landmarks(skin.get(), landmarks, BODICE_LANDMARKS));
  for (int i = 0; i < BODICE_LANDMARKS; ++i) {
    const body::Landmark& same = expected->anatomy.landmarks[static_cast<std::size_t>(i)];
    CHECK(bodice_landmark_name(i) == std::string(body::name(same.id)));
    CHECK(landmarks[i].position[1] == same.position.y());
    CHECK(landmarks[i].confidence == same.confidence);
  }
  double values[BODICE_MEASUREMENTS];
  must(bodice_skin_get_measurements(skin.get(), values, BODICE_MEASUREMENTS));
  const body::Measurements taken = anatomy::measure(mesh, expected->anatomy);
  for (int i = 0; i < BODICE_MEASUREMENTS; ++i)
    CHECK((values[i] == taken.value[static_cast<std::size_t>(i)] || std::isnan(values[i])));
  CHECK(bodice_measurement_name(0) == std::string("height"));
  CHECK(values[0] == doctest::Approx(1.68).epsilon(0.02));
  CHECK(bodice_landmark_name(BODICE_LANDMARKS) == nullptr);
  CHECK(bodice_measurement_name(-1) == nullptr);
  CHECK(bodice_skin_warning(skin.get(), info->warnings) == nullptr);
  CHECK(info->joints == 0);
  CHECK(bodice_skin_joint_name(skin.get(), 0) == nullptr);
  CHECK(bodice_skin_joint_parent(skin.get(), 0) == -1);
}

TEST_CASE("capi: the joints of a skin have names and parents") {
  const synth::Body body = make_body();
  MeshArrays arrays(body.mesh);
  const Context context = make_context();
  bodice_skin_options options = bodice_default_skin_options();
  options.find_rig = 1;
  const auto skin = Skin::from_mesh(context, arrays.mesh(), options);
  REQUIRE_MESSAGE(skin, bodice_last_error());
  const auto info = skin->info();
  REQUIRE(info->joints > 15);
  std::map<std::string, std::string> parent;
  for (std::uint32_t joint = 0; joint < info->joints; ++joint) {
    const std::int32_t above = bodice_skin_joint_parent(skin->get(), joint);
    CHECK(above < static_cast<std::int32_t>(joint));
    const char* name =
        above < 0 ? "" : bodice_skin_joint_name(skin->get(), static_cast<std::uint32_t>(above));
    parent[bodice_skin_joint_name(skin->get(), joint)] = name;
  }
  CHECK(parent.at("pelvis") == "");
  CHECK(parent.at("calf_l") == "thigh_l");
  CHECK(parent.at("hand_r") == "forearm_r");
  CHECK(bodice_skin_joint_name(skin->get(), info->joints) == nullptr);
  CHECK(bodice_skin_joint_parent(skin->get(), info->joints) == -1);
}

TEST_CASE("capi: what is no person is a skin with parts of its own, if it is wanted") {
  geometry::TriMesh tetrahedron;
  tetrahedron.positions = {{0, 0, 0}, {50, 0, 0}, {0, 50, 0}, {0, 0, 50}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const Context context = make_context();
  MeshArrays arrays(tetrahedron);
  bodice_skin_options options = bodice_default_skin_options();
  CHECK(options.shape == BODICE_SHAPE_PERSON);
  options.shape = 2;
  CHECK(Skin::from_mesh(context, arrays.mesh(), options).status() == BODICE_INVALID_ARGUMENT);
  options.shape = BODICE_SHAPE_ANY;
  auto made = Skin::from_mesh(context, arrays.mesh(), options);
  REQUIRE_MESSAGE(made, bodice_last_error());
  const Skin skin = std::move(*made);
  const auto info = skin.info();
  REQUIRE(info);
  std::vector<std::uint8_t> part(info->vertices);
  must(bodice_skin_get_parts(skin.get(), part.data(), part.size()));
  for (const std::uint8_t each : part) CHECK((each >= BODICE_PARTS && each < BODICE_ALL_PARTS));
  double value = 0.0;
  CHECK(bodice_skin_get_measurements(skin.get(), &value, 1) == BODICE_INVALID_ARGUMENT);
  bodice_landmark mark;
  must(bodice_skin_get_landmarks(skin.get(), &mark, 1));
  CHECK(mark.confidence == 0.0);
  bodice_fit_options fit = bodice_default_fit_options();
  fit.tier = BODICE_SOLID;
  CHECK(skin.fit(context, fit));
}

TEST_CASE("capi: centimeters and what is no body are refused with a remedy") {
  const synth::Body body = make_body();
  const Context context = make_context();
  MeshArrays centimeters(body.mesh, 100.0);
  auto refused = Skin::from_mesh(context, centimeters.mesh());
  CHECK(refused.status() == BODICE_INVALID_ARGUMENT);
  CHECK(std::string(bodice_last_error()).find("0.01") != std::string::npos);

  geometry::TriMesh tetrahedron;
  tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  MeshArrays small(tetrahedron);
  CHECK(Skin::from_mesh(context, small.mesh()).status() == BODICE_UNUSABLE_GEOMETRY);
  CHECK(Skin::from_file(context, "no/such/file.obj").status() == BODICE_NOT_FOUND);
  CHECK(std::string(bodice_last_error()).find("no/such/file.obj") != std::string::npos);
  bodice_skin* skin = nullptr;
  CHECK(bodice_skin_built_in(context.get(), 1, std::nan(""), nullptr, &skin) == BODICE_INVALID_ARGUMENT);
  CHECK(skin == nullptr);
}

TEST_CASE("capi: the progress hook hears the stages and cancels") {
  MeshArrays arrays(make_body().mesh);
  const Context context = make_context();
  struct Host {
    int calls = 0, cancel_at = 1 << 30;
    std::string last;
  } host;
  bodice_skin_options options = bodice_default_skin_options();
  options.host = &host;
  options.progress = [](void* given, const char* stage) -> std::int32_t {
    Host& h = *static_cast<Host*>(given);
    h.last = stage;
    return ++h.calls >= h.cancel_at;
  };
  CHECK(Skin::from_mesh(context, arrays.mesh(), options));
  CHECK(host.last == "segment");
  CHECK(host.calls >= 2);
  for (const int at : {1, 2}) {
    host = {};
    host.cancel_at = at;
    CHECK(Skin::from_mesh(context, arrays.mesh(), options).status() == BODICE_CANCELED);
  }
}
