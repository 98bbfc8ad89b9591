#include "report.hpp"

#include <cstdio>

#include "capacity.hpp"

namespace bodice_bench {
namespace {

template <class... Args>
std::string format(const char* pattern, Args... args) {
  char text[512];
  std::snprintf(text, sizeof text, pattern, args...);
  return text;
}

double speed_up(const std::vector<Sample>& samples, const Sample& sample) {
  return samples.front().min_ms / sample.min_ms;
}

std::string mark(const Sample& sample) {
  std::string text = sample.processors < kFairShare * sample.workers
                         ? format("gave %.2f of %d", sample.processors, sample.workers)
                         : "";
  if (!sample.same_bits) text += " BITS DIFFER";
  return text;
}

std::string cost_table(const std::vector<Cost>& costs) {
  std::string text =
      "## Cost of scheduling, beside raw TBB in the same run\n\n"
      "| what | unit | engine, median | raw TBB, median | ratio | engine, least | raw, least | ratio |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const Cost& cost : costs) {
    text += format("| %s | %s | %.1f | %.1f | %.2f | %.1f | %.1f | %.2f |\n", cost.what.c_str(),
                   cost.unit.c_str(), cost.engine, cost.tbb, cost.engine / cost.tbb, cost.engine_min,
                   cost.tbb_min, cost.engine_min / cost.tbb_min);
  }
  return text;
}

std::string limit_table(const std::vector<Limit>& limits) {
  std::string text =
      "\n## What the blocks allow: work and span of a serial run, in processor time\n\n"
      "Independent of the machine's load: the least speed-up of a scheduler that never idles beside ready "
      "blocks.\n\n"
      "| stage | size | work ms | span ms | 2 workers | 4 | 8 | 16 |\n|---|---|---|---|---|---|---|---|\n";
  for (const Limit& limit : limits) {
    const WorkSpan& ws = limit.work_span;
    text += format("| %s | %zu %s | %.2f | %.3f | %.2f | %.2f | %.2f | %.2f |\n", limit.stage.c_str(),
                   limit.size, limit.element.c_str(), ws.work_ms, ws.span_ms, ws.speed_up(2), ws.speed_up(4),
                   ws.speed_up(8), ws.speed_up(16));
  }
  return text;
}

std::string strong_table(const std::vector<std::vector<Sample>>& stages) {
  std::string text =
      "\n## Strong scaling: the same work for more workers\n\n"
      "| stage | size | workers | least ms | median ms | CPU ms | speed-up | efficiency | imbalance | serial "
      "fraction | machine |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& samples : stages) {
    for (const Sample& sample : samples) {
      const double gain = speed_up(samples, sample);
      const bool last = &sample == &samples.back();
      text += format("| %s | %zu %s | %d | %.3f | %.3f | %.3f | %.2f | %.2f | %.2f | %s | %s |\n",
                     sample.stage.c_str(), sample.size, sample.element.c_str(), sample.workers, sample.min_ms,
                     sample.median_ms, sample.cpu_ms, gain, gain / sample.workers, sample.imbalance,
                     last ? format("%.3f", serial_fraction(samples)).c_str() : "", mark(sample).c_str());
    }
  }
  return text;
}

std::string weak_table(const std::vector<std::vector<Sample>>& stages) {
  std::string text =
      "\n## Weak scaling: work grows with the workers\n\n"
      "| stage | size | workers | least ms | median ms | CPU ms | efficiency | machine "
      "|\n|---|---|---|---|---|---|---|---|\n";
  for (const auto& samples : stages) {
    for (const Sample& sample : samples) {
      text += format("| %s | %zu %s | %d | %.3f | %.3f | %.3f | %.2f | %s |\n", sample.stage.c_str(),
                     sample.size, sample.element.c_str(), sample.workers, sample.min_ms, sample.median_ms,
                     sample.cpu_ms, speed_up(samples, sample), mark(sample).c_str());
    }
  }
  return text;
}

}  // namespace

std::string to_markdown(const std::vector<Limit>& limits, const std::vector<std::vector<Sample>>& strong,
                        const std::vector<std::vector<Sample>>& weak, const std::vector<Cost>& costs,
                        const Origin& origin) {
  return "# Scaling\n\n" + title(origin) +
         ".\nSpeed-ups are of least times; worker counts take turns. One worker has the processors in turn, "
         "and the\n"
         "mean of their paces counts: a host may lend unequal ones. Runs count only where the machine, "
         "probed\n"
         "before and after with threads that share nothing, gave the processors it has; 'gave 1.4 of 2' "
         "marks a\n"
         "row for which it never did.\n\n" +
         cost_table(costs) + limit_table(limits) + strong_table(strong) + weak_table(weak);
}

std::string to_csv(const std::vector<std::vector<Sample>>& stages, const Origin& origin) {
  std::string text =
      "stage,scaling,size,element,workers,least_ms,median_ms,cpu_ms,imbalance,processors,same_bits,repeats,"
      "commit,compiler,cpu\n";
  for (const auto& samples : stages) {
    for (const Sample& s : samples) {
      text += format("\"%s\",%s,%zu,%s,%d,%.5f,%.5f,%.5f,%.4f,%.4f,%d,%d,%s,\"%s\",\"%s\"\n", s.stage.c_str(),
                     s.weak ? "weak" : "strong", s.size, s.element.c_str(), s.workers, s.min_ms, s.median_ms,
                     s.cpu_ms, s.imbalance, s.processors, s.same_bits ? 1 : 0, s.repeats,
                     origin.commit.c_str(), origin.compiler.c_str(), origin.cpu.c_str());
    }
  }
  return text;
}

std::string to_svg(const std::vector<std::vector<Sample>>& strong, const Origin& origin) {
  constexpr double kSize = 360.0, kLeft = 50.0, kTop = 40.0;
  int most = 2;
  for (const auto& samples : strong) most = std::max(most, samples.back().workers);
  auto x_of = [&](double workers) { return kLeft + kSize * (workers - 1) / (most - 1); };
  auto y_of = [&](double gain) { return kTop + kSize * (1.0 - (gain - 1) / (most - 1)); };
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 460\" font-family=\"sans-serif\" "
      "font-size=\"12\" "
      "stroke-width=\"2\" fill=\"none\">\n<rect width=\"720\" height=\"460\" fill=\"white\"/>\n";
  auto label = [&](double x, double y, const std::string& text, const std::string& fill) {
    svg += format("<text stroke=\"none\" fill=\"%s\" x=\"%.1f\" y=\"%.1f\">", fill.c_str(), x, y) + text +
           "</text>\n";
  };
  label(kLeft, 20, "Speed-up over workers; " + title(origin), "#333");
  svg += format("<path stroke=\"#bbb\" stroke-dasharray=\"5 4\" d=\"M%.1f %.1f L%.1f %.1f\"/>\n", x_of(1),
                y_of(1), x_of(most), y_of(most));
  for (int n = 1; n <= most; n = n < 4 ? n + 1 : n * 2) {
    label(x_of(n) - 3, kTop + kSize + 18, std::to_string(n), "#333");
    label(kLeft - 22, y_of(n) + 4, std::to_string(n), "#333");
  }
  const char* const colors[] = {"#1f4e8c", "#d1495b", "#2e8b57", "#e0a030", "#6a4c93",
                                "#00798c", "#9c6644", "#555",    "#c77dff"};
  for (std::size_t i = 0; i < strong.size(); ++i) {
    const std::string color = colors[i % std::size(colors)];
    std::string path;
    for (const Sample& sample : strong[i]) {
      path += format("%s%.1f %.1f ", path.empty() ? "M" : "L", x_of(sample.workers),
                     y_of(speed_up(strong[i], sample)));
    }
    svg += "<path stroke=\"" + color + "\" d=\"" + path + "\"/>\n";
    label(kLeft + kSize + 20, kTop + 20.0 * static_cast<double>(i + 1),
          strong[i].front().stage + format("  %.2f", speed_up(strong[i], strong[i].back())), color);
  }
  return svg + "</svg>\n";
}

}  // namespace bodice_bench
