#include <algorithm>
#include <cstdio>
#include <string_view>

#include "measure.hpp"

namespace bodice_bench {
namespace {

using namespace bodice::engine;

constexpr double kWidth = 960.0, kLane = 46.0, kLeft = 90.0, kTop = 40.0;

std::string_view fill_of(std::string_view name) {
  if (name == "frame") return "#1f4e8c";
  if (name == "frame loop") return "#6ea8e5";
  if (name == "background block") return "#e0a030";
  return "#f4ddb0";
}

/// The height of a bar. Blocks and loops are lower than the jobs and frames that they are drawn over.
double height_of(std::string_view name) {
  if (name == "frame loop" || name == "background block") return kLane - 22.0;
  return kLane - 8.0;
}

void append_rect(std::string& svg, double x, double y, double width, double height, std::string_view fill) {
  char text[200];
  std::snprintf(text, sizeof text,
                "<rect x=\"%.2f\" y=\"%.1f\" width=\"%.2f\" height=\"%.1f\" fill=\"%.*s\"/>\n", x, y,
                std::max(width, 0.4), height, static_cast<int>(fill.size()), fill.data());
  svg += text;
}

void append_text(std::string& svg, double x, double y, std::string_view text) {
  svg += "<text x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\">" + std::string(text) +
         "</text>\n";
}

void append_legend(std::string& svg, double y) {
  double x = kLeft;
  for (const std::string_view name : {"frame", "frame loop", "fit a body", "background block"}) {
    append_rect(svg, x, y, 14.0, 14.0, fill_of(name));
    append_text(svg, x + 20.0, y + 12.0, name);
    x += 160.0;
  }
  append_text(svg, x, y + 12.0, "&#9650; result published");
}

/// A bar of the picture: one event of the trace, or several that touch.
struct Bar {
  std::size_t lane;
  double left, right;
  std::string_view fill;
  double height;
};

/// Adds a bar, or extends the last bar of its lane and color if the two touch in the picture.
void add_bar(std::vector<Bar>& bars, const Bar& bar) {
  for (auto last = bars.rbegin(); last != bars.rend() && last - bars.rbegin() < 64; ++last) {
    if (last->lane != bar.lane || last->fill != bar.fill) continue;
    if (bar.left - last->right > 0.25) break;
    last->right = std::max(last->right, bar.right);
    return;
  }
  bars.push_back(bar);
}

}  // namespace

std::string timeline_svg(const Trace& trace, std::string_view from_event, double length_ms) {
  const auto events = trace.events();
  const auto first =
      std::ranges::find(events, from_event, [](const TraceEvent& e) { return std::string_view(e.name); });
  const std::int64_t start_ns = first == events.end() ? 0 : first->begin_ns + 400'000'000;
  const double scale = (kWidth - kLeft - 20.0) / length_ms;
  auto x_of = [&](std::int64_t ns) {
    return kLeft + std::clamp(static_cast<double>(ns - start_ns) * 1e-6, 0.0, length_ms) * scale;
  };
  std::vector<std::thread::id> threads;
  std::vector<Bar> bars;
  std::string marks;
  for (const TraceEvent& event : events) {
    auto found = std::ranges::find(threads, event.thread);
    if (found == threads.end()) found = threads.insert(threads.end(), event.thread);
    const auto lane = static_cast<std::size_t>(found - threads.begin());
    const double left = x_of(event.begin_ns), right = x_of(event.end_ns);
    if (right <= kLeft || left >= kLeft + length_ms * scale) continue;
    if (event.begin_ns == event.end_ns) {
      append_text(marks, left - 5.0, kTop + kLane * static_cast<double>(lane + 1), "&#9650;");
    } else {
      add_bar(bars, {lane, left, right, fill_of(event.name), height_of(event.name)});
    }
  }
  std::string body;
  for (const Bar& bar : bars) {
    const double y = kTop + kLane * static_cast<double>(bar.lane) + (kLane - 4.0 - bar.height) / 2;
    append_rect(body, bar.left, y, bar.right - bar.left, bar.height, bar.fill);
  }
  const double height = kTop + kLane * static_cast<double>(threads.size()) + 40.0;
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 960 " +
      std::to_string(static_cast<int>(height)) +
      "\" font-family=\"sans-serif\" font-size=\"13\" stroke=\"none\">\n<rect width=\"960\" height=\"" +
      std::to_string(static_cast<int>(height)) + "\" fill=\"white\"/>\n";
  append_legend(svg, 10.0);
  for (std::size_t i = 0; i < threads.size(); ++i) {
    append_text(svg, 8.0, kTop + kLane * (static_cast<double>(i) + 0.55),
                i == 0 ? "host" : "worker " + std::to_string(i));
  }
  svg += body + marks;
  for (int tick = 0; tick <= 5; ++tick) {
    const double ms = length_ms * tick / 5;
    char label[32];
    std::snprintf(label, sizeof label, "%.0f ms", ms);
    append_text(svg, kLeft + ms * scale - 12.0, height - 15.0, label);
  }
  return svg + "</svg>\n";
}

}  // namespace bodice_bench
