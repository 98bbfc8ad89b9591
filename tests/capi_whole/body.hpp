// A made body as a program has it: arrays of floats, triangles and weights.
#pragma once

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <bodice.hpp>
#include <bodice/synth/body.hpp>

namespace capi_test {

/// Throws what the suite cannot go on without.
inline void must(bodice_status status) {
  REQUIRE_MESSAGE(status == BODICE_OK, std::string(bodice_last_error()));
}

inline bodice::Context make_context(int workers = 2) {
  bodice_context_options options = bodice_default_context_options();
  options.workers = workers;
  auto context = bodice::Context::create(options);
  REQUIRE_MESSAGE(context, bodice_last_error());
  return std::move(*context);
}

/// Arrays that a bodice_mesh refers to.
struct MeshArrays {
  std::vector<double> xyz;
  std::vector<std::uint32_t> triangles;

  explicit MeshArrays(const bodice::geometry::TriMesh& mesh, double scale = 1.0) {
    for (const auto& p : mesh.positions)
      for (int axis = 0; axis < 3; ++axis) xyz.push_back(scale * p[axis]);
    for (const auto& t : mesh.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
  }
  bodice_mesh mesh() {
    bodice_mesh mesh = bodice_default_mesh();
    mesh.position = {xyz.data(), nullptr, nullptr, 0, BODICE_DOUBLE, 0};
    mesh.vertices = xyz.size() / 3;
    mesh.index = triangles.data();
    mesh.triangles = triangles.size() / 3;
    return mesh;
  }
};

inline bodice::synth::Body make_body(int vertices = 4500) {
  auto made = bodice::synth::make_body({}, {.vertices = vertices});
  REQUIRE(made);
  return std::move(made).value();
}

inline bodice::Skin make_skin(const bodice::Context& context, MeshArrays& arrays,
                              const bodice_skin_options& options = bodice_default_skin_options()) {
  auto skin = bodice::Skin::from_mesh(context, arrays.mesh(), options);
  REQUIRE_MESSAGE(skin, bodice_last_error());
  return std::move(*skin);
}

inline bodice_fit_options solid() {
  bodice_fit_options options = bodice_default_fit_options();
  options.tier = BODICE_SOLID;
  return options;
}

inline std::uint64_t hash_of(const bodice_proxy* proxy) {
  bodice_proxy_info info = bodice_default_proxy_info();
  must(bodice_proxy_get_info(proxy, &info));
  return info.hash;
}

}  // namespace capi_test
