#include "bench_support/plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace bench {
namespace {

constexpr double kWidth = 860, kHeight = 560, kLeft = 78, kRight = 200, kTop = 48, kBottom = 78;
constexpr const char* kColors[] = {"#1f4e8c", "#d1495b", "#2e8b57", "#e08a00", "#6a4c93",
                                   "#00798c", "#9c6644", "#444444", "#c0399f"};

bool shows(const PlotPoint& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0.0 && p.y > 0.0;
}

/// A logarithmic axis from `low` to `high`, drawn from pixel `from` to pixel `to`.
struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = 0.0, from = 0.0, to = 0.0;

  void extend(double value) { low = std::min(low, value), high = std::max(high, value); }
  void finish() {
    if (!(low <= high)) low = high = 1.0;
    low /= 1.3, high *= 1.3;
  }
  double at(double value) const { return from + (to - from) * std::log(value / low) / std::log(high / low); }

  /// Values of the ticks: 1, 2 and 5 times powers of ten; over many decades only the powers.
  std::vector<double> ticks() const {
    const bool dense = high / low < 2e3;
    std::vector<double> values;
    for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, power) <= high; ++power)
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double value = digit * std::pow(10.0, power);
        if (value >= low && value <= high && (dense || digit == 1.0)) values.push_back(value);
      }
    return values;
  }
};

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text)
    safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return safe;
}

template <class... Args>
std::string format(const char* pattern, Args... args) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, args...);
  return text;
}

std::string words(double x, double y, const std::string& text, const char* style) {
  return format("<text x='%.1f' y='%.1f' %s>", x, y, style) + escaped(text) + "</text>\n";
}

/// A number for an axis, without exponents: 50000, 1 million.
std::string number(double value) {
  return value >= 1e6 ? format("%g million", 1e-6 * value) : format("%g", value);
}

std::string frame(const Plot& plot, const Axis& x, const Axis& y) {
  std::string svg = format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.0f %.0f' width='%.0f' height='%.0f' "
      "font-family='sans-serif' font-size='13'>\n<rect width='100%%' height='100%%' fill='white'/>\n",
      kWidth, kHeight, kWidth, kHeight);
  for (const double value : x.ticks()) {
    svg += format("<path stroke='#ddd' d='M%.1f %.1fV%.1f'/>\n", x.at(value), y.from, y.to);
    svg += words(x.at(value), kHeight - kBottom + 18, number(value), "text-anchor='middle'");
  }
  for (const double value : y.ticks()) {
    svg += format("<path stroke='#ddd' d='M%.1f %.1fH%.1f'/>\n", x.from, y.at(value), x.to);
    svg += words(kLeft - 8, y.at(value) + 4, number(value), "text-anchor='end'");
  }
  svg += words(kLeft, 26, plot.title, "font-size='16'");
  svg += words(0.5 * (x.from + x.to), kHeight - kBottom + 40, plot.x_label, "text-anchor='middle'");
  svg += format("<g transform='translate(20 %.1f) rotate(-90)'>", 0.5 * (y.from + y.to)) +
         words(0, 0, plot.y_label, "text-anchor='middle'") + "</g>\n";
  return svg + words(kLeft, kHeight - 12, plot.footer, "font-size='10' fill='#777'");
}

/// The labels drawn so far. A new label goes to the first free corner of its point.
class Labels {
 public:
  std::string put(double x, double y, const std::string& text, const char* color) {
    constexpr double kHigh = 11, kWide = 6, kAway = 6;
    const double width = kWide * static_cast<double>(text.size());
    const Box corners[] = {{x + kAway, y - kAway, width},
                           {x + kAway, y + kAway + kHigh, width},
                           {x - kAway - width, y - kAway, width},
                           {x - kAway - width, y + kAway + kHigh, width},
                           {x + kAway, y - kAway - kHigh, width}};
    const auto hits = [&](const Box& a) {
      return std::ranges::any_of(taken_, [&](const Box& b) {
        return a.x < b.x + b.width && b.x < a.x + a.width && std::abs(a.y - b.y) < kHigh;
      });
    };
    const auto at = std::ranges::find_if_not(corners, hits);
    const Box& box = at == std::end(corners) ? corners[0] : *at;
    taken_.push_back(box);
    return words(box.x, box.y, text, format("font-size='10' fill='%s'", color).c_str());
  }

 private:
  struct Box {
    double x, y, width;  ///< of the text's left end on its base line
  };
  std::vector<Box> taken_;
};

std::string draw(const PlotSeries& series, const char* color, const Axis& x, const Axis& y, Labels& labels) {
  std::string path, marks;
  for (const PlotPoint& p : series.points) {
    if (!shows(p)) continue;
    path += format("%s%.1f %.1f", path.empty() ? "M" : "L", x.at(p.x), y.at(p.y));
    marks += format("<circle cx='%.1f' cy='%.1f' r='4' stroke='%s' stroke-width='2' fill='%s'/>\n", x.at(p.x),
                    y.at(p.y), color, series.hollow ? "white" : color);
    if (!p.label.empty()) marks += labels.put(x.at(p.x), y.at(p.y), p.label, color);
  }
  if (series.line)
    path = format("<path fill='none' stroke-width='1.5' stroke='%s' d='", color) + path + "'/>\n";
  return (series.line ? path : "") + marks;
}

}  // namespace

std::string to_svg(const Plot& plot) {
  Axis x, y;
  x.from = kLeft, x.to = kWidth - kRight, y.from = kHeight - kBottom, y.to = kTop;
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& p : series.points)
      if (shows(p)) x.extend(p.x), y.extend(p.y);
  x.finish(), y.finish();
  std::string svg = frame(plot, x, y);
  Labels labels;
  double legend_y = kTop + 10;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    const std::size_t index = series.color < 0 ? i : static_cast<std::size_t>(series.color);
    const char* const color = kColors[index % std::size(kColors)];
    if (std::ranges::none_of(series.points, shows)) continue;
    svg += draw(series, color, x, y, labels);
    svg += format("<circle cx='%.1f' cy='%.1f' r='4' stroke='%s' stroke-width='2' fill='%s'/>\n",
                  kWidth - kRight + 18, legend_y - 4, color, series.hollow ? "white" : color);
    svg += words(kWidth - kRight + 28, legend_y, series.name, "");
    legend_y += 20;
  }
  return svg + "</svg>\n";
}

}  // namespace bench
