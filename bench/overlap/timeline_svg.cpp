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

// Jobs behind, their blocks and the frame's loops in front.
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

}  // namespace

std::string timeline_svg(const Trace& trace, double from_ms, double to_ms) {
  const auto events = trace.events();
  std::vector<std::thread::id> threads;
  const std::int64_t start_ns = events.empty() ? 0 : events.front().begin_ns;
  const double scale = (kWidth - kLeft - 20.0) / (to_ms - from_ms);
  auto x_of = [&](std::int64_t ns) {
    const double ms = std::clamp(static_cast<double>(ns - start_ns) * 1e-6, from_ms, to_ms);
    return kLeft + (ms - from_ms) * scale;
  };
  std::string body;
  for (const TraceEvent& event : events) {
    auto lane = std::ranges::find(threads, event.thread);
    if (lane == threads.end()) lane = threads.insert(threads.end(), event.thread);
    const double y = kTop + kLane * static_cast<double>(lane - threads.begin());
    const double x = x_of(event.begin_ns), width = x_of(event.end_ns) - x;
    const bool inside = static_cast<double>(event.end_ns - start_ns) * 1e-6 >= from_ms &&
                        static_cast<double>(event.begin_ns - start_ns) * 1e-6 <= to_ms;
    if (!inside) continue;
    if (event.begin_ns == event.end_ns) {
      append_text(body, x - 5.0, y + kLane, "&#9650;");
    } else {
      append_rect(body, x, y + (kLane - 4.0 - height_of(event.name)) / 2, width, height_of(event.name),
                  fill_of(event.name));
    }
  }
  const double height = kTop + kLane * static_cast<double>(threads.size()) + 60.0;
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 960 " +
      std::to_string(static_cast<int>(height)) +
      "\" font-family=\"sans-serif\" font-size=\"13\" stroke=\"none\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n";
  append_legend(svg, 10.0);
  for (std::size_t i = 0; i < threads.size(); ++i) {
    append_text(svg, 8.0, kTop + kLane * (static_cast<double>(i) + 0.55),
                i == 0 ? "host" : "worker " + std::to_string(i));
  }
  svg += body;
  for (int tick = 0; tick <= 5; ++tick) {
    const double ms = (to_ms - from_ms) * tick / 5;
    char label[32];
    std::snprintf(label, sizeof label, "%.0f ms", ms);
    append_text(svg, kLeft + ms * scale - 12.0, height - 20.0, label);
  }
  return svg + "</svg>\n";
}

}  // namespace bodice_bench
