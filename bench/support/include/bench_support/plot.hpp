#pragma once

#include <string>
#include <vector>

namespace bench {

/// A point of a plot.
struct PlotPoint {
  double x = 0.0, y = 0.0;
  std::string label;  ///< text beside the point; may be empty
};

/// Points with one color and one entry in the legend.
struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
  bool line = false;    ///< whether a line joins the points in the order given
  bool hollow = false;  ///< circles rather than discs; used for other libraries
  int color = -1;       ///< index into the palette; -1: the index of the series
};

/// Series over two logarithmic axes, with a legend. Points that are not positive and finite are left out.
struct Plot {
  std::string title, x_label, y_label;
  std::string footer;  ///< the origin of the numbers
  std::vector<PlotSeries> series;
};

/// The plot as a file in SVG.
std::string to_svg(const Plot& plot);

}  // namespace bench
