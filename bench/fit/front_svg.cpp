#include "front_svg.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace fit_bench {
namespace {

constexpr double kWidth = 720, kHeight = 480, kLeft = 70, kRight = 110, kTop = 40, kBottom = 60;

/// A logarithmic axis of the picture.
struct Axis {
  double low, high, from, to;
  double at(double value) const { return from + (to - from) * std::log(value / low) / std::log(high / low); }
};

void text(std::ostream& out, double x, double y, const std::string& words, const char* anchor = "middle") {
  out << "<text x='" << x << "' y='" << y << "' text-anchor='" << anchor << "'>" << words << "</text>\n";
}

std::string number(double value) {
  std::ostringstream words;
  words << value;
  return words.str();
}

/// The name of a line at its end.
struct Label {
  double y;
  std::string words;
};

/// Writes the names at least a line of text apart, also where lines end close together.
void names(std::ostream& out, std::vector<Label> labels) {
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.y < b.y; });
  double least_y = 0.0;
  for (const Label& label : labels) {
    const double y = std::max(label.y, least_y);
    text(out, kWidth - kRight + 8, y + 4, label.words, "start");
    least_y = y + 15.0;
  }
}

void frame(std::ostream& out, const Axis& x, const Axis& y) {
  out << "<svg xmlns='http://www.w3.org/2000/svg' width='" << kWidth << "' height='" << kHeight
      << "' font-family='sans-serif' font-size='13'>\n<rect width='100%' height='100%' fill='white'/>\n";
  for (const double n : {8.0, 16.0, 32.0, 55.0, 89.0, 200.0, 400.0}) {
    out << "<path stroke='#ddd' d='M" << x.at(n) << ' ' << y.from << 'V' << y.to << "'/>\n";
    text(out, x.at(n), kHeight - kBottom + 20, number(n));
  }
  for (const double e : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (e < y.low || e > y.high) continue;
    out << "<path stroke='#ddd' d='M" << x.from << ' ' << y.at(e) << 'H' << x.to << "'/>\n";
    text(out, kLeft - 8, y.at(e) + 4, number(e), "end");
  }
  text(out, 0.5 * (x.from + x.to), kHeight - 18, "ellipsoids");
  text(out, kLeft, 24, "mean error of the signed distance within 30 mm of the skin, mm", "start");
}

}  // namespace

bool write_front_svg(const std::filesystem::path& file, const std::vector<FrontPoint>& points) {
  std::map<std::string, std::map<double, std::pair<double, int>>> logs;
  double least = 1.0, most = 1.0;
  for (const FrontPoint& p : points) {
    if (!(p.error_mm > 0.0)) continue;
    auto& [sum, count] = logs[p.tier][p.ellipsoids];
    sum += std::log(p.error_mm);
    ++count;
    least = std::min(least, p.error_mm);
    most = std::max(most, p.error_mm);
  }
  const Axis x{7.0, 450.0, kLeft, kWidth - kRight};
  const Axis y{0.9 * least, 1.1 * most, kHeight - kBottom, kTop};
  std::ofstream out(file);
  frame(out, x, y);
  const char* const colors[] = {"#1b7f5c", "#c0392b", "#2c5aa0", "#8e44ad"};
  int color = 0;
  std::vector<Label> labels;
  for (const auto& [tier, line] : logs) {
    const char* const stroke = colors[color++ % 4];
    out << "<polyline fill='none' stroke-width='2' stroke='" << stroke << "' points='";
    double last_y = 0.0;
    for (const auto& [count, sum] : line) {
      last_y = y.at(std::exp(sum.first / sum.second));
      out << x.at(count) << ',' << last_y << ' ';
    }
    out << "'/>\n";
    for (const auto& [count, sum] : line)
      out << "<circle r='3' fill='" << stroke << "' cx='" << x.at(count) << "' cy='"
          << y.at(std::exp(sum.first / sum.second)) << "'/>\n";
    labels.push_back({last_y, tier});
  }
  names(out, std::move(labels));
  out << "</svg>\n";
  return out.good();
}

}  // namespace fit_bench
