#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>

#include <bodice/binding/poser.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/engine/text.hpp>
#include <bodice/engine/write_file.hpp>
#include <bodice/proxy/base_pose.hpp>

#include "options/options.hpp"
#include "options/validators.hpp"
#include "output/outputs.hpp"
#include "output/terminal.hpp"
#include "run/motion_time.hpp"
#include "run/prepared_poses.hpp"

namespace bodice::inline v0_1::cli {
namespace {

using geometry::Vec3;

struct QueryCommand {
  std::string proxy, points, output;
  MotionTime motion;
  bool refit = false;
  std::string body;                                         ///< the file to refit for; empty: the motion's
  double within = std::numeric_limits<double>::infinity();  ///< in the unit of the proxy's file
  bool fast = false;
};

/// Points, one a line; `name` is what sentences call the stream.
engine::Result<std::vector<Vec3>> read_points(std::istream& in, const std::string& name) {
  std::vector<Vec3> points;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // some editors begin UTF-8 so
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
    std::istringstream fields(line);
    Vec3 p;
    std::string rest;
    if (!(fields >> p.x() >> p.y() >> p.z()) || (fields >> rest))
      return engine::Error{engine::ErrorCode::kUnreadable,
                           name + ": line " + std::to_string(number) + " is not three numbers.",
                           "Write one point a line: x y z."};
    points.push_back(p);
  }
  if (in.bad() || std::ferror(stdin) != 0)
    return engine::Error{engine::ErrorCode::kUnreadable, name + ": cannot be read to its end.",
                         "Check the file."};
  return points;
}

engine::Result<std::vector<Vec3>> read_points(const std::string& file) {
  if (file == "-") return read_points(std::cin, "standard input");
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    return engine::Error{engine::ErrorCode::kUnreadable, file + " is a folder.", "Name a file of points."};
  std::ifstream in(file);
  if (!in)
    return engine::Error{engine::ErrorCode::kNotFound, file + ": cannot be opened.",
                         "Check the path, and that the file may be read."};
  return read_points(in, file);
}

std::string answer(const collision::Collider& collider, const proxy::BodyProxy& proxy,
                   const collision::QueryOptions& options, const Vec3& file_point) {
  const geometry::Frame& frame = proxy.frame();
  const Eigen::Vector3f local = (frame.to_inside(file_point) - collider.origin()).cast<float>();
  const collision::Contact c = collider.query({local.x(), local.y(), local.z()}, options);
  if (c.ellipsoid == collision::kNoEllipsoid) return "inf nan nan nan nan nan nan none\n";
  const Vec3 point =
      frame.to_file(collider.origin() + Vec3(double{c.point[0]}, double{c.point[1]}, double{c.point[2]}));
  const Vec3 normal =
      frame.direction_to_file({double{c.normal[0]}, double{c.normal[1]}, double{c.normal[2]}});
  std::string line;
  engine::append_number(line, double{c.signed_distance} / frame.meters_per_unit, 7);
  for (const double v : point) engine::append_number(line += ' ', v, 9);
  for (const double v : normal) engine::append_number(line += ' ', v, 6);
  return line + ' ' + std::to_string(c.ellipsoid) + '\n';
}

std::string posed_answer(const binding::Poser& poser, const Vec3& file_point) {
  const geometry::Frame& frame = poser.bound().frame();
  const Vec3 at = frame.to_inside(file_point);
  const proxy::ProxyDistance found = proxy::posed_proxy_distance(poser.bound(), poser.posed(), at);
  const Vec3 point = frame.to_file(at - found.distance * found.normal);
  const Vec3 normal = frame.direction_to_file(found.normal);
  std::string line;
  engine::append_number(line, found.distance / frame.meters_per_unit, 7);
  for (const double v : point) engine::append_number(line += ' ', v, 9);
  for (const double v : normal) engine::append_number(line += ' ', v, 6);
  return line + ' ' + std::to_string(found.owner) + '\n';
}

engine::Result<std::string> posed_answers(const proxy::ProxyWithBases& both, const QueryCommand& command,
                                          const std::vector<Vec3>& points) {
  const engine::Context context;
  auto poser = binding::Poser::make(both.proxy);
  if (!poser) return std::move(poser).error();
  for (const auto& base : both.bases)
    if (auto kept = poser->keep_base(base); !kept) return std::move(kept).error();
  const auto joints = joints_at(context, *both.proxy.binding(), command.motion);
  if (!joints) return joints.error();
  if (command.refit) {
    const std::string& body = command.body.empty() ? command.motion.choice.motion : command.body;
    auto base = refit_for(context, both.proxy, body, *joints);
    if (!base) return std::move(base).error();
    if (auto added = poser->add_base(*base); !added) return std::move(added).error();
  }
  if (auto posed = poser->pose(context, *joints); !posed) return posed.error();
  std::string text;
  for (const Vec3& p : points) text += posed_answer(*poser, p);
  return text;
}

std::string answers(const proxy::BodyProxy& proxy, const QueryCommand& command,
                    const std::vector<Vec3>& points) {
  const collision::Collider collider(proxy);
  collision::QueryOptions options{.within_m =
                                      static_cast<float>(command.within * proxy.frame().meters_per_unit)};
  if (command.fast) options.accuracy = collision::Accuracy::kFirstOrder;
  std::string text;
  for (const Vec3& p : points) text += answer(collider, proxy, options, p);
  return text;
}

engine::Result<void> query(const QueryCommand& command) {
  const bool prints = command.output.empty() || command.output == "-";
  const FileOption output{"-o", prints ? "" : command.output};
  const FileOption inputs[] = {{"PROXY", command.proxy},
                               {"POINTS", command.points},
                               {"--motion", command.motion.choice.motion},
                               {"--body", command.body}};
  if (auto ok = check_outputs({&output, 1}, inputs); !ok) return ok;
  auto both = proxy::load_with_bases(command.proxy);
  if (!both) return std::move(both).error();
  auto points = read_points(command.points);
  if (!points) return std::move(points).error();
  const auto text = command.motion.choice.motion.empty()
                        ? engine::Result<std::string>(answers(both->proxy, command, *points))
                        : posed_answers(*both, command, *points);
  if (!text) return text.error();
  if (!prints) return engine::write_file(command.output, std::string_view(*text));
  std::fputs(text->c_str(), stdout);
  return {};
}

/// Options of the pose that is queried. Returns that of the motion.
CLI::Option* add_pose_options(CLI::App& sub, QueryCommand& command) {
  CLI::Option* const motion =
      sub.add_option("--motion", command.motion.choice.motion,
                     "pose a proxy that is bound to joints by a clip of this file (GLB, FBX, DAE, BVH)")
          ->check(not_empty());
  sub.add_option("--clip", command.motion.choice.clip, "name of the clip (default: the file's first)")
      ->check(not_empty())
      ->needs(motion);
  sub.add_option("--time", command.motion.time_s, "seconds of the clip, from 0 (default: 0)")
      ->check(zero_or_more())
      ->needs(motion);
  CLI::Option* const refit =
      sub.add_flag("--refit", command.refit,
                   "solve the proxy's tables anew in that pose before answering (some tenths of a second)")
          ->needs(motion);
  sub.add_option("--body", command.body,
                 "with --refit: the body that the proxy was fitted to (default: the file of --motion)")
      ->check(not_empty())
      ->needs(refit);
  return motion;
}

}  // namespace

void add_query_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<QueryCommand>();
  CLI::App* sub = app.add_subcommand("query", "Evaluate a proxy's signed distances and closest points");
  sub->add_option("PROXY", command->proxy, "a proxy that `bodice fit` wrote")->check(not_empty())->required();
  sub->add_option("POINTS", command->points,
                  "text, one point a line: x y z, in the proxy's units and axes; - reads standard input")
      ->check(not_empty())
      ->required();
  sub->add_option("-o,--output", command->output, "where to write (default: standard output)")
      ->check(not_empty());
  CLI::Option* const motion = add_pose_options(*sub, *command);
  sub->add_option("--within", command->within,
                  "leave out what is farther away, in the proxy's units (default: nothing)")
      ->check(zero_or_more())
      ->excludes(motion);
  sub->add_flag("--fast", command->fast,
                "distances to first order: half the time, and an error that vanishes toward the surface")
      ->excludes(motion);
  sub->footer(
      "A line a point: signed distance (negative inside), closest point x y z, normal x y z, ellipsoid (from "
      "0);\n`inf nan ... none` beyond --within, and where single precision does not reach, millions of body "
      "lengths away.\n"
      "Example: bodice query proxy.json points.txt");
  sub->callback([command, &exit_code] {
    const auto done = query(*command);
    exit_code = done ? kExitOk : fail(done.error());
  });
}

}  // namespace bodice::cli
