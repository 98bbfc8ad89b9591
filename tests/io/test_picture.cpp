#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <set>

#include <png.h>

#include <bodice_test/temp_folder.hpp>

#include "scene_fixture.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  std::array<int, 3> at(int x, int y) const {
    const std::size_t i =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
  /// Whether a pixel is neither backdrop nor ground, which are both light and nearly neutral.
  bool drawn(int x, int y) const {
    const auto [r, g, b] = at(x, y);
    return std::max({r, g, b}) - std::min({r, g, b}) > 14;
  }
};

Picture read(const std::filesystem::path& file) {
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_file(&header, file.c_str()));
  header.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  picture.rgb.resize(PNG_IMAGE_SIZE(header));
  REQUIRE(png_image_finish_read(&header, nullptr, picture.rgb.data(), 0, nullptr));
  return picture;
}

Picture drawn(const io::Scene& scene, std::span<const std::size_t> frames,
              const io::PictureOptions& options) {
  const TempFolder folder;
  const auto result = io::write_picture(scene, frames, folder / "a.png", options);
  REQUIRE_MESSAGE(result.ok(), (result.ok() ? std::string() : result.error().sentence()));
  return read(folder / "a.png");
}

/// The number of drawn pixels in a rectangle.
int count(const Picture& picture, int x0, int y0, int x1, int y1) {
  int n = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) n += picture.drawn(x, y);
  return n;
}

constexpr io::PictureOptions kSmall{.width = 120, .height = 200};

}  // namespace

TEST_CASE("the body stands where it should in the front and the side view") {
  const SceneFixture fixture;
  const Picture picture = drawn(fixture.scene, {}, kSmall);
  REQUIRE(picture.width == 240);
  REQUIRE(picture.height == 200);
  for (const int middle : {60, 180}) {
    CHECK(picture.drawn(middle, 60));
    CHECK(picture.drawn(middle, 140));
  }
  for (const int corner : {3, 117, 123, 237})
    for (const int y : {3, 196}) CHECK(!picture.drawn(corner, y));
  // The figure is wider from the front (.56 m and more) than from the side (about .32 m).
  const int front = count(picture, 0, 0, 120, 200), side = count(picture, 120, 0, 240, 200);
  CHECK(side > 1000);
  CHECK(front > 1.4 * side);
}

TEST_CASE("parts have their own colors, garments cover the body, frames differ") {
  const SceneFixture fixture;
  const Picture parts = drawn(fixture.scene, {}, kSmall);
  CHECK(parts.at(60, 50) != parts.at(60, 150));
  const std::array<std::size_t, 2> frames = {0, 2};
  const Picture draped = drawn(fixture.scene, frames, kSmall);
  REQUIRE(draped.height == 400);
  const auto [r, g, b] = draped.at(60, 130);  // the skirt is blue, the skin is not
  CHECK(b > r + 30);
  const auto [skin_r, skin_g, skin_b] = draped.at(60, 40);
  CHECK(skin_r >= skin_b);
  int differ = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 240; ++x) differ += draped.at(x, y) != draped.at(x, y + 200);
  CHECK(differ > 200);
}

TEST_CASE("the same scene gives the same bytes") {
  const SceneFixture fixture;
  CHECK(drawn(fixture.scene, {}, kSmall).rgb == drawn(fixture.scene, {}, kSmall).rgb);
}

TEST_CASE("ellipsoids can be shown in place of the skin") {
  const SceneFixture fixture;
  io::PictureOptions options = kSmall;
  options.show_proxy = true;
  const Picture picture = drawn(fixture.scene, {}, options);
  CHECK(count(picture, 0, 0, 120, 200) > 500);
  CHECK(picture.rgb != drawn(fixture.scene, {}, kSmall).rgb);
}

TEST_CASE("the proxy's surface can be shown in place of its ellipsoids, if it is that of the proxy") {
  const SceneFixture fixture;
  io::PictureOptions options = kSmall;
  options.show_proxy = true;
  const Picture ellipsoids = drawn(fixture.scene, {}, options);
  auto surface = proxy::proxy_surface({}, *fixture.scene.proxy, 0.01);
  REQUIRE(surface.ok());
  io::Scene scene = fixture.scene;
  scene.surface = &*surface;
  const Picture picture = drawn(scene, {}, options);
  int differ = 0;  // pixels drawn in one picture only
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 240; ++x) differ += picture.drawn(x, y) != ellipsoids.drawn(x, y);
  CHECK(differ < 100);                               // pixels of the outline
  CHECK(picture.at(60, 50) != picture.at(60, 150));  // different parts
  const TempFolder folder;
  for (int broken = 0; broken < 3; ++broken) {
    proxy::ProxySurface other = *surface;
    if (broken == 0) other.owner.back() = 2;
    if (broken == 1) other.normals.pop_back();
    if (broken == 2) other.mesh.triangles.back()[1] = 1'000'000;
    scene.surface = &other;
    CHECK(!io::write_picture(scene, {}, folder / "a.png", options).ok());
  }
}

TEST_CASE("the fifteen parts have fifteen colors") {
  std::set<std::array<float, 3>> colors;
  for (int i = 0; i < body::kPartCount; ++i) {
    const auto color = io::part_color(static_cast<body::Part>(i));
    colors.insert({color[0], color[1], color[2]});
    for (const float c : color) CHECK((c >= 0.0f && c <= 1.0f));
  }
  CHECK(colors.size() == body::kPartCount);
}

TEST_CASE("a frame that does not exist and absurd sizes are refused") {
  const TempFolder folder;
  const SceneFixture fixture;
  const std::array<std::size_t, 1> beyond = {3};
  for (const auto& [frames, options] :
       {std::pair<std::span<const std::size_t>, io::PictureOptions>{beyond, kSmall},
        {{}, {.width = 0, .height = 100}},
        {{}, {.width = 100'000, .height = 100}}}) {
    const auto result = io::write_picture(fixture.scene, frames, folder / "a.png", options);
    REQUIRE(!result.ok());
    CHECK(result.error().code == engine::ErrorCode::kInvalidArgument);
  }
}

TEST_CASE("a contact sheet has one view for each frame, row by row, and shows the skin of that frame") {
  SceneFixture fixture;
  io::Scene scene = fixture.scene;
  std::vector<std::vector<geometry::Vec3>> skin(3, scene.body->positions);
  for (geometry::Vec3& p : skin[2]) p *= 0.5;  // at half the size, the ground at 0
  scene.body_frames = skin;
  const TempFolder folder;
  const std::size_t frames[] = {0, 1, 2};
  const io::PictureOptions options{.width = 80, .height = 120, .show_garments = false};
  const auto result = io::write_contact_sheet(scene, frames, 2, folder / "sheet.png", options);
  REQUIRE_MESSAGE(result.ok(), (result.ok() ? std::string() : result.error().sentence()));
  const Picture sheet = read(folder / "sheet.png");
  CHECK(sheet.width == 160);
  CHECK(sheet.height == 240);
  const int first = count(sheet, 0, 0, 80, 120), second = count(sheet, 80, 0, 160, 120),
            third = count(sheet, 0, 120, 80, 240);
  CHECK(first > 100);
  CHECK(second == first);
  CHECK(third == doctest::Approx(0.25 * first).epsilon(0.15));
  CHECK(count(sheet, 80, 120, 160, 240) == 0);
}

TEST_CASE("a contact sheet without frames, without columns or of a frame that is not there is refused") {
  SceneFixture fixture;
  const io::Scene scene = fixture.scene;
  const TempFolder folder;
  const std::size_t frames[] = {0, 99};
  CHECK(!io::write_contact_sheet(scene, {}, 2, folder / "a.png").ok());
  CHECK(!io::write_contact_sheet(scene, std::span(frames, 1), 0, folder / "a.png").ok());
  CHECK(!io::write_contact_sheet(scene, frames, 2, folder / "a.png").ok());
  CHECK(!std::filesystem::exists(folder / "a.png"));
}

TEST_CASE("a legend stands in a strip below the views, in its colors and with its numbers") {
  const SceneFixture fixture;
  const std::size_t frames[] = {0};
  io::PictureOptions options{.width = 300, .height = 400};
  const Picture plain = drawn(fixture.scene, frames, options);
  options.legend = io::Legend{{{0.0f, 0.0f, 1.0f}, {1.0f, 1.0f, 1.0f}, {1.0f, 0.0f, 0.0f}},
                              -3.0,
                              3.0,
                              "mm",
                              "proxy outside",
                              "skin outside"};
  const Picture with = drawn(fixture.scene, frames, options);
  CHECK(with.width == plain.width);
  REQUIRE(with.height > plain.height + 20);
  CHECK(std::equal(plain.rgb.begin(), plain.rgb.end(), with.rgb.begin()));
  const int bar = plain.height + 8;  // its rows have the scale from a quarter of the width to three quarters
  CHECK(with.at(150, bar) == std::array<int, 3>{0, 0, 255});
  CHECK(with.at(449, bar) == std::array<int, 3>{255, 0, 0});
  const auto [r, g, b] = with.at(224, bar);  // a quarter of the bar: halfway from blue to white
  CHECK(r == doctest::Approx(127).epsilon(0.03));
  CHECK(g == r);
  CHECK(b == 255);
  const auto dots = [](const Picture& picture, int x0, int x1) {
    int n = 0;
    for (int y = picture.height - 30; y < picture.height; ++y)
      for (int x = x0; x < x1; ++x) n += picture.at(x, y)[0] < 100;
    return n;
  };
  CHECK(dots(with, 150, 240) > 100);
  CHECK(dots(with, 360, 450) > 100);
  CHECK(dots(with, 0, 149) + dots(with, 451, 600) == 0);
  options.legend->most = 8.0;  // an eight has more dots than a three
  CHECK(dots(drawn(fixture.scene, frames, options), 360, 450) > dots(with, 360, 450));
  options.legend->colors.resize(1);
  const TempFolder folder;
  CHECK_FALSE(io::write_picture(fixture.scene, frames, folder / "a.png", options).ok());
}
