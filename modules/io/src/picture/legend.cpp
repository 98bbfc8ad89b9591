#include "legend.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <bodice/engine/text.hpp>

#include "letters.hpp"

namespace bodice::inline v0_1::io {

namespace {

constexpr std::uint8_t kPaper = 245;
constexpr int kBarHeight = 8, kGap = 4, kStripHeight = kBarHeight + 2 * kLetterHeight + 4 * kGap;  // dots

std::string number(double value, const std::string& unit) {
  std::string text;
  engine::append_number(text, value, 3);
  return unit.empty() ? text : text + " " + unit;
}

/// The color at a share of the bar's length, linear between the given ones.
std::array<std::uint8_t, 3> color_at(const Legend& legend, double share) {
  const double at = share * static_cast<double>(legend.colors.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(at), legend.colors.size() - 2);
  const auto t = static_cast<float>(at - static_cast<double>(first));
  std::array<std::uint8_t, 3> color;
  for (std::size_t k = 0; k < 3; ++k)
    color[k] = static_cast<std::uint8_t>(
        std::lround(255.0f * std::lerp(legend.colors[first][k], legend.colors[first + 1][k], t)));
  return color;
}

void draw_bar(const Legend& legend, int x, int y, int width, int height, Image& image) {
  for (int column = 0; column < width; ++column) {
    const auto color = color_at(legend, width > 1 ? static_cast<double>(column) / (width - 1) : 0.0);
    for (int row = y; row < y + height; ++row) {
      const auto at = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(x + column));
      std::ranges::copy(color, image.rgb.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
}

}  // namespace

void add_legend(const Legend& legend, Image& image) {
  const int dot = std::max(1, std::min(image.width / 600, image.height / 400));
  int y = image.height + dot * kGap;
  image.height += dot * kStripHeight;
  image.rgb.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
                   kPaper);
  const int width = image.width / 2, x = image.width / 4;
  draw_bar(legend, x, y, width, dot * kBarHeight, image);
  y += dot * (kBarHeight + kGap);
  const std::string least = number(legend.least, legend.unit), most = number(legend.most, legend.unit),
                    middle = number(0.5 * (legend.least + legend.most), "");
  draw_text(least, x, y, dot, image);
  draw_text(middle, x + (width - text_width(middle, dot)) / 2, y, dot, image);
  draw_text(most, x + width - text_width(most, dot), y, dot, image);
  y += dot * (kLetterHeight + kGap);
  draw_text(legend.at_least, x, y, dot, image);
  draw_text(legend.at_most, x + width - text_width(legend.at_most, dot), y, dot, image);
}

}  // namespace bodice::io
