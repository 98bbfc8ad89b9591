#include "line_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include <png.h>

namespace bench {
namespace {

constexpr int kWidth = 1000, kPanel = 190, kLegend = 40, kLeft = 70, kRight = 20, kTop = 24, kBottom = 26;

struct Rgb {
  std::uint8_t r, g, b;
};
constexpr Rgb kInk{40, 40, 40}, kGrid{220, 220, 220};
constexpr std::array<Rgb, 6> kColors = {
    {{31, 78, 140}, {46, 139, 87}, {209, 73, 91}, {224, 138, 0}, {106, 76, 147}, {68, 68, 68}}};

/// Glyphs of 5 x 7 dots, row by row from the top, five bits a row.
struct Glyph {
  char letter;
  std::array<std::uint8_t, 7> rows;
};
constexpr Glyph kFont[] = {
    {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},
    {'2', {14, 17, 1, 6, 8, 16, 31}},    {'3', {30, 1, 1, 14, 1, 1, 30}},
    {'4', {2, 6, 10, 18, 31, 2, 2}},     {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {6, 8, 16, 30, 17, 17, 14}},   {'7', {31, 1, 2, 4, 8, 8, 8}},
    {'8', {14, 17, 17, 14, 17, 17, 14}}, {'9', {14, 17, 17, 15, 1, 2, 12}},
    {'.', {0, 0, 0, 0, 0, 12, 12}},      {',', {0, 0, 0, 0, 12, 4, 8}},
    {'-', {0, 0, 0, 31, 0, 0, 0}},       {'_', {0, 0, 0, 0, 0, 0, 31}},
    {'/', {1, 1, 2, 4, 8, 16, 16}},      {'(', {2, 4, 8, 8, 8, 4, 2}},
    {')', {8, 4, 2, 2, 2, 4, 8}},        {'%', {24, 25, 2, 4, 8, 19, 3}},
    {':', {0, 12, 12, 0, 12, 12, 0}},    {'A', {14, 17, 17, 31, 17, 17, 17}},
    {'B', {30, 17, 17, 30, 17, 17, 30}}, {'C', {14, 17, 16, 16, 16, 17, 14}},
    {'D', {30, 17, 17, 17, 17, 17, 30}}, {'E', {31, 16, 16, 30, 16, 16, 31}},
    {'F', {31, 16, 16, 30, 16, 16, 16}}, {'G', {14, 17, 16, 23, 17, 17, 15}},
    {'H', {17, 17, 17, 31, 17, 17, 17}}, {'I', {14, 4, 4, 4, 4, 4, 14}},
    {'J', {7, 2, 2, 2, 2, 18, 12}},      {'K', {17, 18, 20, 24, 20, 18, 17}},
    {'L', {16, 16, 16, 16, 16, 16, 31}}, {'M', {17, 27, 21, 21, 17, 17, 17}},
    {'N', {17, 25, 21, 19, 17, 17, 17}}, {'O', {14, 17, 17, 17, 17, 17, 14}},
    {'P', {30, 17, 17, 30, 16, 16, 16}}, {'Q', {14, 17, 17, 17, 21, 18, 13}},
    {'R', {30, 17, 17, 30, 20, 18, 17}}, {'S', {15, 16, 16, 14, 1, 1, 30}},
    {'T', {31, 4, 4, 4, 4, 4, 4}},       {'U', {17, 17, 17, 17, 17, 17, 14}},
    {'V', {17, 17, 17, 17, 17, 10, 4}},  {'W', {17, 17, 17, 21, 21, 27, 17}},
    {'X', {17, 17, 10, 4, 10, 17, 17}},  {'Y', {17, 17, 10, 4, 4, 4, 4}},
    {'Z', {31, 1, 2, 4, 8, 16, 31}},
};

class Canvas {
 public:
  Canvas(int width, int height)
      : width_(width),
        height_(height),
        rgb_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255) {}

  void dot(int x, int y, Rgb c) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    std::uint8_t* at = &rgb_[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                  static_cast<std::size_t>(x))];
    at[0] = c.r, at[1] = c.g, at[2] = c.b;
  }
  void line(double x0, double y0, double x1, double y1, Rgb c, int thick = 1) {
    const int steps = 1 + static_cast<int>(2.0 * std::max(std::abs(x1 - x0), std::abs(y1 - y0)));
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      for (int k = 0; k < thick; ++k)
        for (int m = 0; m < thick; ++m)
          dot(static_cast<int>(std::lround(x0 + t * (x1 - x0))) + m,
              static_cast<int>(std::lround(y0 + t * (y1 - y0))) + k, c);
    }
  }
  void text(int x, int y, const std::string& words, Rgb c) {
    for (const char letter : words) {
      const char upper = letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
      const auto* const glyph = std::ranges::find(kFont, upper, &Glyph::letter);
      if (glyph != std::end(kFont))
        for (int row = 0; row < 7; ++row)
          for (int column = 0; column < 5; ++column)
            if (glyph->rows[static_cast<std::size_t>(row)] >> (4 - column) & 1) dot(x + column, y + row, c);
      x += 6;
    }
  }
  bool write(const std::filesystem::path& file) const {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width_);
    image.height = static_cast<png_uint_32>(height_);
    image.format = PNG_FORMAT_RGB;
    return png_image_write_to_file(&image, file.c_str(), 0, rgb_.data(), 0, nullptr) != 0;
  }

 private:
  int width_, height_;
  std::vector<std::uint8_t> rgb_;
};

/// Smaller values are drawn on the axis, since exact methods have only rounding.
constexpr double kLeast = 0.05;

/// Maps values to pixels; y is logarithmic.
struct Scale {
  double x_end = 0.0, y_low = 1e300, y_high = 0.0;
  int top = 0;

  explicit Scale(const LinePanel& panel, int top_pixel) : top(top_pixel) {
    for (const Line& line : panel.lines)
      for (std::size_t i = 0; i < line.x.size(); ++i) {
        x_end = std::max(x_end, line.x[i]);
        if (line.y[i] > 0.0) y_low = std::min(y_low, line.y[i]), y_high = std::max(y_high, line.y[i]);
      }
    y_low = std::max(y_low / 1.2, kLeast), y_high *= 1.2;
  }
  double x(double value) const { return kLeft + (kWidth - kLeft - kRight) * value / std::max(x_end, 1e-9); }
  double y(double value) const {
    const double share = std::log(std::max(value, y_low) / y_low) / std::log(y_high / y_low);
    return top + kPanel - kBottom - (kPanel - kTop - kBottom) * share;
  }
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

void draw_grid(const Scale& scale, Canvas& canvas) {
  for (double decade = 1e-6; decade < scale.y_high; decade *= 10.0)
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * decade;
      if (value < scale.y_low || value > scale.y_high) continue;
      canvas.line(kLeft, scale.y(value), kWidth - kRight, scale.y(value), kGrid);
      canvas.text(kLeft - 6 * static_cast<int>(number(value).size()) - 4,
                  static_cast<int>(scale.y(value)) - 3, number(value), kInk);
    }
  for (int tick = 0; tick <= 4; ++tick) {
    const double value = 0.25 * tick * scale.x_end;
    canvas.text(static_cast<int>(scale.x(value)) - 6, scale.top + kPanel - kBottom + 6,
                number(0.01 * std::round(100.0 * value)), kInk);
  }
}

}  // namespace

bool write_line_plot(const std::vector<LinePanel>& panels, const std::string& y_label,
                     const std::filesystem::path& png) {
  Canvas canvas(kWidth, kLegend + kPanel * static_cast<int>(panels.size()));
  int legend_x = kLeft, legend_y = 8;
  for (std::size_t i = 0; !panels.empty() && i < panels.front().lines.size(); ++i) {
    const std::string& name = panels.front().lines[i].name;
    const int wide = 19 + 6 * static_cast<int>(name.size()) + 18;
    if (legend_x + wide > kWidth) legend_x = kLeft, legend_y += 14;
    canvas.line(legend_x, legend_y + 3, legend_x + 14, legend_y + 3, kColors[i % kColors.size()], 3);
    canvas.text(legend_x + 19, legend_y, name, kInk);
    legend_x += wide;
  }
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Scale scale(panels[p], kLegend + kPanel * static_cast<int>(p));
    draw_grid(scale, canvas);
    canvas.text(kLeft, scale.top + 8, panels[p].title + ": " + y_label, kInk);
    for (std::size_t i = 0; i < panels[p].lines.size(); ++i) {
      const Line& line = panels[p].lines[i];
      for (std::size_t k = 1; k < line.x.size(); ++k)
        canvas.line(scale.x(line.x[k - 1]), scale.y(line.y[k - 1]), scale.x(line.x[k]), scale.y(line.y[k]),
                    kColors[i % kColors.size()], 2);
    }
  }
  return canvas.write(png);
}

}  // namespace bench
