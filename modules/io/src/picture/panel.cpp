#include "panel.hpp"

#include <array>

namespace bodice::inline v0_1::io {

namespace {

constexpr int kSuper = 3;  // samples a pixel and axis
constexpr float kMargin = 0.05f;
constexpr float kInsideOfCloth = 0.55f;
constexpr float kEdgeBrightness = 0.35f;
constexpr float kEdgeWidth = 0.5f * kSuper;   // half its thickness, samples
constexpr float kGroundLine = 0.6f * kSuper;  // half its thickness, samples

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
  view.pixels_per_meter = (1.0f - 2.0f * kMargin) * fit;
  return view;
}

/// Converts linear light to sRGB by table, since a power a sample would cost more than the drawing.
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

/// The triangle and actor that each sample shows. Shading comes last, once a pixel and triangle.
class Panel {
 public:
  Panel(const std::vector<Actor>& actors, const geometry::Box& box, const View& view)
      : actors_(actors),
        view_(view),
        lighting_(actors, box, view),
        depth_(view),
        seen_(depth_.depth.size(), kNone) {
    const geometry::Vec3 ground(box.center().x(), box.low.y(), box.center().z());
    ground_y_ = view.project(ground.cast<float>()).y();
    for (std::uint32_t a = 0; a < actors.size(); ++a) draw(a);
  }

  /// The mean of a pixel's samples in linear light.
  Vec3f pixel(int x, int y) const {
    std::array<std::uint32_t, kSuper * kSuper> ids;
    std::size_t n = 0;
    Vec3f sum = Vec3f::Zero();
    for (int sy = 0; sy < kSuper; ++sy)
      for (int sx = 0; sx < kSuper; ++sx) ids[n++] = seen_[depth_.at(x * kSuper + sx, y * kSuper + sy)];
    for (std::size_t first = 0; first < n; ++first) {
      if (std::find(ids.begin(), ids.begin() + first, ids[first]) != ids.begin() + first) continue;
      sum += ids[first] == kNone ? backdrop_of(ids, y) : triangle_of(ids, first, x, y);
    }
    return sum / static_cast<float>(n);
  }

 private:
  using Ids = std::array<std::uint32_t, kSuper * kSuper>;
  struct Drawn {
    std::uint32_t actor;
    std::uint32_t triangle;
    FlatTriangle flat;
  };
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  void draw(std::uint32_t a) {
    const Actor& actor = actors_[a];
    std::vector<Vec3f> projected;
    projected.reserve(actor.positions.size());
    for (const Vec3f& p : actor.positions) projected.push_back(view_.project(p));
    for (std::uint32_t t = 0; t < actor.triangles.size(); ++t) {
      const auto& [i, j, k] = actor.triangles[t];
      const auto id = static_cast<std::uint32_t>(drawn_.size());
      drawn_.push_back({a, t, {projected[i], projected[j], projected[k]}});
      draw_triangle(depth_, drawn_.back().flat, [&](std::size_t sample) { seen_[sample] = id; });
    }
  }

  Vec3f backdrop(float sample_y) const {
    const float t = sample_y / static_cast<float>(view_.height);
    const Vec3f color = (1.0f - t) * Vec3f(0.96f, 0.97f, 0.98f) + t * Vec3f(0.86f, 0.87f, 0.88f);
    const float below = sample_y - ground_y_;
    if (std::abs(below) < kGroundLine) return Vec3f::Constant(0.42f);
    return below > 0.0f ? Vec3f(0.93f * color) : color;
  }

  Vec3f backdrop_of(const Ids& ids, int y) const {
    Vec3f sum = Vec3f::Zero();
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (ids[i] == kNone) sum += backdrop(static_cast<float>(y * kSuper + static_cast<int>(i) / kSuper));
    return sum;
  }

  /// The light of one triangle times its samples, shaded at the middle of those samples.
  Vec3f triangle_of(const Ids& ids, std::size_t first, int x, int y) const {
    float px = 0.0f, py = 0.0f, count = 0.0f;
    for (std::size_t i = first; i < ids.size(); ++i) {
      if (ids[i] != ids[first]) continue;
      px += static_cast<float>(x * kSuper + static_cast<int>(i) % kSuper) + 0.5f;
      py += static_cast<float>(y * kSuper + static_cast<int>(i) / kSuper) + 0.5f;
      count += 1.0f;
    }
    const Drawn& drawn = drawn_[ids[first]];
    return count * shade(drawn, drawn.flat.weights(px / count, py / count)).cwiseMin(1.0f);
  }

  Vec3f shade(const Drawn& drawn, const Vec3f& w) const {
    const Actor& actor = actors_[drawn.actor];
    const auto& [i, j, k] = actor.triangles[drawn.triangle];
    auto mix = [&, i = i, j = j, k = k](const std::vector<Vec3f>& values) {
      return Vec3f(w[0] * values[i] + w[1] * values[j] + w[2] * values[k]);
    };
    Vec3f normal = mix(actor.normals).normalized(), color = mix(actor.colors);
    if (normal.dot(view_.toward_eye) < 0.0f && actor.two_sided) {
      normal = -normal;
      color *= kInsideOfCloth;
    }
    if (actor.edges && drawn.flat.distance_to_edges(w) < kEdgeWidth) color *= kEdgeBrightness;
    return lighting_.shade(mix(actor.positions), normal, view_.toward_eye, color);
  }

  const std::vector<Actor>& actors_;
  View view_;
  Lighting lighting_;
  DepthBuffer depth_;
  std::vector<std::uint32_t> seen_;  // index into drawn_
  std::vector<Drawn> drawn_;
  float ground_y_ = 0.0f;  // samples from the top
};

}  // namespace

void draw_panel(const std::vector<Actor>& actors, const geometry::Box& box, Side side, const Rectangle& where,
                Image& image) {
  const Panel panel(actors, box, panel_view(box, side, where.width, where.height));
  const SrgbTable srgb;
  for (int y = 0; y < where.height; ++y) {
    std::size_t out = 3 * (static_cast<std::size_t>(where.y + y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(where.x));
    for (int x = 0; x < where.width; ++x) {
      const Vec3f color = panel.pixel(x, y);
      for (int k = 0; k < 3; ++k) image.rgb[out++] = srgb(color[k]);
    }
  }
}

}  // namespace bodice::io
