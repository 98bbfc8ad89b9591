// The paper's figures 11 and 12: the time a frame against the body's vertices, and against the garment's.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <bench_support/plot.hpp>
#include <bench_support/table.hpp>

namespace paper_bench {

/// The times of a frame for one body and one garment.
struct FrameTimes {
  std::size_t body_vertices = 0, particles = 0, ellipsoids = 0;
  double paper_ms = 0.0;  ///< the paper's tier and its response
  double solid_ms = 0.0;  ///< tier solid and the exact closest point
  double trees_ms = 0.0;  ///< two trees of boxes, refitted; they detect contacts and do not respond
  std::size_t tree_contacts = 0;
};

/// Receives a line about each measurement before it begins.
using Progress = std::function<void(const std::string&)>;

/// Figure 11: one garment of `particles` vertices over bodies of these sizes.
std::vector<FrameTimes> over_body_vertices(std::span<const int> body_vertices, int particles,
                                           const Progress& progress);
/// Figure 12: garments of these sizes over a body of 8,850 vertices, the paper's Female 2.
std::vector<FrameTimes> over_particles(std::span<const int> particles, const Progress& progress);

bench::Table frame_table(const std::string& name, const std::string& caption,
                         const std::vector<FrameTimes>& rows);
bench::Plot frame_plot(const std::string& title, bool over_bodies, const std::vector<FrameTimes>& rows);

}  // namespace paper_bench
