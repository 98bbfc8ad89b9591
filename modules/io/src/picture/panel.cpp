#include "panel.hpp"

#include <array>

namespace bodice::io {

namespace {

constexpr int kSuper = 3;  // samples a pixel and axis
constexpr float kMargin = 0.05f;
constexpr float kInsideOfCloth = 0.55f;

View panel_view(const geometry::Box& box, Side side, int width, int height) {
  View view;
  view.up = Vec3f::UnitY();
  view.toward_eye = side == Side::kFront ? Vec3f(Vec3f::UnitZ()) : Vec3f(Vec3f::UnitX());
  view.right = view.up.cross(view.toward_eye);
  view.center = box.center().cast<float>();
  view.width = width * kSuper;
  view.height = height * kSuper;
  const Vec3f size = box.size().cast<float>();
  const float wide = std::max(size.x(), size.z()), tall = size.y();  // one scale for both sides
  const float fit = std::min(static_cast<float>(view.width) / std::max(wide, 1e-30f),
                             static_cast<float>(view.height) / std::max(tall, 1e-30f));
  view.pixels_per_metre = (1.0f - 2.0f * kMargin) * fit;
  return view;
}

/// sRGB of linear light, by table: a power a sample would cost more than the drawing.
class SrgbTable {
 public:
  SrgbTable() {
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const float v = static_cast<float>(i) / static_cast<float>(table_.size() - 1);
      const float srgb = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
      table_[i] = static_cast<std::uint8_t>(std::lround(255.0f * srgb));
    }
  }
  std::uint8_t operator()(float linear) const {
    const float scaled = std::clamp(linear, 0.0f, 1.0f) * static_cast<float>(table_.size() - 1);
    return table_[static_cast<std::size_t>(scaled + 0.5f)];
  }

 private:
  std::array<std::uint8_t, 4096> table_;
};

struct Panel {
  explicit Panel(const View& v) : view(v), depth(v), color(depth.depth.size()) {}
  View view;
  DepthBuffer depth;
  std::vector<Vec3f> color;  // linear
};

void paint_backdrop(Panel& panel, float ground_y) {
  const float line = 0.6f * kSuper;
  for (int y = 0; y < panel.view.height; ++y) {
    const float t = static_cast<float>(y) / static_cast<float>(panel.view.height);
    Vec3f color = (1.0f - t) * Vec3f(0.96f, 0.97f, 0.98f) + t * Vec3f(0.86f, 0.87f, 0.88f);
    const float below = static_cast<float>(y) - ground_y;
    if (below > 0.0f) color *= 0.93f;
    if (std::abs(below) < line) color = Vec3f::Constant(0.42f);
    std::fill_n(panel.color.begin() + static_cast<std::ptrdiff_t>(panel.depth.at(0, y)), panel.view.width,
                color);
  }
}

void draw_actor(const Actor& actor, const Lighting& lighting, Panel& panel) {
  const Vec3f eye = panel.view.toward_eye;
  std::vector<Vec3f> projected;
  projected.reserve(actor.positions.size());
  for (const Vec3f& p : actor.positions) projected.push_back(panel.view.project(p));
  auto mix = [](const std::vector<Vec3f>& values, const geometry::Triangle& t, const Vec3f& w) {
    return Vec3f(w[0] * values[t[0]] + w[1] * values[t[1]] + w[2] * values[t[2]]);
  };
  for (const geometry::Triangle& t : actor.triangles)
    draw_triangle(panel.depth, projected[t[0]], projected[t[1]], projected[t[2]],
                  [&](std::size_t pixel, const Vec3f& w) {
                    Vec3f normal = mix(actor.normals, t, w).normalized();
                    Vec3f color = mix(actor.colors, t, w);
                    if (actor.two_sided && normal.dot(eye) < 0.0f) {
                      normal = -normal;
                      color *= kInsideOfCloth;
                    }
                    panel.color[pixel] = lighting.shade(mix(actor.positions, t, w), normal, eye, color);
                  });
}

/// Averages the samples in linear light.
void resolve(const Panel& panel, int x0, int y0, Image& image) {
  const SrgbTable srgb;
  for (int y = 0; y < panel.view.height / kSuper; ++y)
    for (int x = 0; x < panel.view.width / kSuper; ++x) {
      Vec3f sum = Vec3f::Zero();
      for (int sy = 0; sy < kSuper; ++sy)
        for (int sx = 0; sx < kSuper; ++sx)
          sum += panel.color[panel.depth.at(x * kSuper + sx, y * kSuper + sy)].cwiseMin(1.0f);
      const std::size_t pixel = static_cast<std::size_t>(y0 + y) * static_cast<std::size_t>(image.width) +
                                static_cast<std::size_t>(x0 + x);
      for (int k = 0; k < 3; ++k)
        image.rgb[3 * pixel + static_cast<std::size_t>(k)] = srgb(sum[k] / (kSuper * kSuper));
    }
}

}  // namespace

void draw_panel(const std::vector<Actor>& actors, const Lighting& lighting, const geometry::Box& box, Side side,
                int width, int height, int x, int y, Image& image) {
  Panel panel(panel_view(box, side, width, height));
  const geometry::Vec3 ground(box.center().x(), box.low.y(), box.center().z());
  paint_backdrop(panel, panel.view.project(ground.cast<float>()).y());
  for (const Actor& actor : actors) draw_actor(actor, lighting, panel);
  resolve(panel, x, y, image);
}

}  // namespace bodice::io
