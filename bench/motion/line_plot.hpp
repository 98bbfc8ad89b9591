// Lines over time as a PNG, so that any viewer shows them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bench {

/// A line of a plot; x and y are of the same length.
struct Line {
  std::string name;
  std::vector<double> x, y;
};

/// One panel below the other, each with a title, its lines over a linear x and a logarithmic y.
struct LinePanel {
  std::string title;
  std::vector<Line> lines;
};

/// Writes the panels and a legend of the first panel's lines. Returns whether the file was written.
bool write_line_plot(const std::vector<LinePanel>& panels, const std::string& y_label,
                     const std::filesystem::path& png);

}  // namespace bench
