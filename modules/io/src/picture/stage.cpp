#include "stage.hpp"

#include <algorithm>
#include <array>

namespace bodice::inline v0_1::io {

namespace {

constexpr int kLargestShadow = 1536;
constexpr float kShadowBiasPixels = 5.0f;
/// The radius of the ring of shadow samples that makes the penumbra.
constexpr float kPenumbraPixels = 5.0f;

View light_view(const geometry::Box& box, const View& eye) {
  View view;
  view.toward_eye = (-0.5f * eye.right + 0.75f * eye.up + 0.85f * eye.toward_eye).normalized();
  view.right = Vec3f::UnitY().cross(view.toward_eye).normalized();
  view.up = view.toward_eye.cross(view.right);
  view.center = box.center().cast<float>();
  // A small picture shows no finer shadow, and a larger map would take longer than the picture.
  view.width = view.height = std::min(kLargestShadow, std::max(eye.width, eye.height));
  view.pixels_per_meter = static_cast<float>(view.width) / static_cast<float>(1.02 * box.size().norm());
  return view;
}

}  // namespace

Actor make_actor(const geometry::TriMesh& mesh, const Vec3f& color, bool two_sided) {
  Actor actor;
  actor.triangles = mesh.triangles;
  actor.two_sided = two_sided;
  actor.colors.assign(mesh.positions.size(), color);
  for (const geometry::Vec3& p : mesh.positions) actor.positions.push_back(p.cast<float>());
  for (const geometry::Vec3& n : vertex_normals(mesh)) actor.normals.push_back(n.cast<float>());
  return actor;
}

Lighting::Lighting(const std::vector<Actor>& actors, const geometry::Box& box, const View& eye)
    : view_(light_view(box, eye)), shadow_(view_), bias_(kShadowBiasPixels) {
  for (const Actor& actor : actors) {
    if (!actor.casts_shadow) continue;
    for (const auto& [a, b, c] : actor.triangles)
      draw_triangle(shadow_,
                    {view_.project(actor.positions[a]), view_.project(actor.positions[b]),
                     view_.project(actor.positions[c])},
                    [](std::size_t) {});
  }
}

float Lighting::lit(const Vec3f& point, const Vec3f& normal) const {
  constexpr std::array<std::array<float, 2>, 9> ring = {{{0.0f, 0.0f},
                                                         {0.95f, 0.3f},
                                                         {0.45f, -0.85f},
                                                         {-0.3f, 0.95f},
                                                         {-0.85f, -0.45f},
                                                         {0.45f, 0.2f},
                                                         {0.2f, -0.45f},
                                                         {-0.2f, 0.45f},
                                                         {-0.45f, -0.2f}}};
  const Vec3f at = view_.project(point + normal * (bias_ / view_.pixels_per_meter));
  float sum = 0.0f;
  for (const auto& [dx, dy] : ring) {
    const int x = static_cast<int>(at.x() + kPenumbraPixels * dx);
    const int y = static_cast<int>(at.y() + kPenumbraPixels * dy);
    const bool outside = x < 0 || y < 0 || x >= shadow_.width || y >= shadow_.height;
    sum += outside || at.z() - bias_ < shadow_.depth[shadow_.at(x, y)] ? 1.0f : 0.0f;
  }
  return sum / static_cast<float>(ring.size());
}

Vec3f Lighting::shade(const Vec3f& point, const Vec3f& normal, const Vec3f& toward_eye,
                      const Vec3f& color) const {
  const float facing = normal.dot(view_.toward_eye);
  const float key = facing > 0.0f ? facing * lit(point, normal) : 0.0f;
  const float sky = 0.5f + 0.5f * normal.y();
  const float grazing = 1.0f - std::clamp(normal.dot(toward_eye), 0.0f, 1.0f);
  const float rim = grazing * grazing * grazing;
  const Vec3f ambient = sky * Vec3f(0.36f, 0.38f, 0.41f) + (1.0f - sky) * Vec3f(0.17f, 0.155f, 0.145f);
  const Vec3f half = (view_.toward_eye + toward_eye).normalized();
  const float gloss = key * 0.06f * std::pow(std::max(0.0f, normal.dot(half)), 24.0f);
  return color.cwiseProduct(ambient + key * Vec3f(0.80f, 0.77f, 0.72f)) +
         Vec3f::Constant(gloss + 0.05f * rim * sky);
}

}  // namespace bodice::io
