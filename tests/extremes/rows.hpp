// The table of extremes: every public algorithm with every hostile input of its kind, a row each.
#pragma once

#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/geometry/types.hpp>

namespace extremes {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();
inline constexpr double kHalfTurn_rad = std::numbers::pi;

struct Row {
  std::string algorithm, input;
  std::function<std::string()> check;  ///< empty if the result or error is as expected, else what came
};

std::vector<Row> point_rows();      ///< enclosing ellipsoids, clusters
std::vector<Row> ellipsoid_rows();  ///< closest points in double and float, queries, responses, files
std::vector<Row> scene_rows();      ///< unions of ellipsoids that no fit makes, plain and with tables
std::vector<Row> mesh_rows();       ///< everything that takes a mesh
std::vector<Row> body_rows();       ///< a body at any scale and offset is the same body
std::vector<Row> number_rows();     ///< options and steps that are absurd numbers
std::vector<Row> rig_rows();        ///< skeletons, weights, clips and skinning
std::vector<Row> pose_rows();       ///< binding and posing of proxies

/// Returns "" if it holds, else the description of what came.
inline std::string expect(bool holds, std::string_view otherwise) {
  return holds ? std::string() : std::string(otherwise);
}

/// Returns the error's sentence, or an objection if it lacks sentence or remedy.
template <class Result>
std::string check_refusal(const Result& result) {
  if (result.ok()) return "accepted";
  const auto& error = result.error();
  if (error.message.size() < 10 || error.message.back() != '.') return "no sentence: " + error.message;
  return expect(!error.remedy.empty(), "no remedy: " + error.message);
}

}  // namespace extremes
