#pragma once

#include <string>
#include <vector>

namespace bench {

struct PlotPoint {
  double x = 0.0, y = 0.0;
  std::string label;  ///< written beside it, if any
};

struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
  bool line = false;    ///< joined in the order given
  bool hollow = false;  ///< circles rather than discs: a rival
  int color = -1;       ///< of the palette; -1: the series' own place in it
};

/// Series over two logarithmic axes, with a legend. Points that are not positive and finite are left out.
struct Plot {
  std::string title, x_label, y_label;
  std::string footer;  ///< where the numbers come from
  std::vector<PlotSeries> series;
};

std::string to_svg(const Plot& plot);

}  // namespace bench
