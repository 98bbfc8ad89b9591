// Based on: J. Meredith, S. Maddock. Motion Capture File Formats Explained. 2001. - section on BVH
#include "import/scene/bvh.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Geometry>

#include <bodice/rig/skeleton.hpp>

#include "import/scene/scene_rig.hpp"
#include "import/source/input_file.hpp"

namespace bodice::inline v0_1::io {

namespace {

/// No length in any unit and no angle is larger; beyond it products of joints would overflow.
constexpr double kLargest = 1e9;

/// Words of a text, one after the other, with the line of the last one.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word, empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && is_blank(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// What is left of the line, without blanks at its ends and without a brace.
  std::string_view rest_of_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view rest = text_.substr(at_, end - at_);
    if (const std::size_t brace = rest.find('{'); brace != std::string_view::npos)
      rest = rest.substr(0, brace);
    at_ += rest.size();
    while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
    while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
    return rest;
  }

  std::optional<double> number() {
    std::string_view word = next();
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !(std::abs(value) <= kLargest))
      return std::nullopt;
    return value;
  }

  std::size_t line() const { return line_; }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
};

enum class Channel : std::uint8_t { kX, kY, kZ, kTurnX, kTurnY, kTurnZ };

std::optional<Channel> channel_of(std::string_view name) {
  constexpr std::array<std::string_view, 6> kNames = {"xposition", "yposition", "zposition",
                                                      "xrotation", "yrotation", "zrotation"};
  std::string lower(name);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  for (std::size_t k = 0; k < kNames.size(); ++k)
    if (lower == kNames[k]) return static_cast<Channel>(k);
  return std::nullopt;
}

struct NodeChannels {
  std::uint32_t node;
  rig::Vec3 offset;
  std::vector<Channel> channels;
};

class BvhReader {
 public:
  BvhReader(std::string_view text, const std::filesystem::path& file) : words_(text), file_(file) {}

  engine::Result<FileRig> read() {
    if (words_.next() != "HIERARCHY") return wrong("HIERARCHY");
    std::string_view word = words_.next();
    for (; word == "ROOT"; word = words_.next())
      if (auto read = read_tree(); !read) return read.error();
    if (rig_.nodes.empty()) return wrong("ROOT");
    if (word != "MOTION") return wrong("MOTION");
    if (table_.empty()) return wrong("a joint with channels before it");
    if (auto read = read_motion(); !read) return read.error();
    return std::move(rig_);
  }

 private:
  engine::Error wrong(std::string_view expected) const {
    return {engine::ErrorCode::kUnreadable,
            "'" + file_.string() + "' cannot be read as BVH: line " + std::to_string(words_.line()) +
                " should have " + std::string(expected) + ".",
            "Mend that line or export the motion again."};
  }

  std::uint32_t add_node(std::string name, std::int32_t parent) {
    FileNode& node = rig_.nodes.emplace_back();
    node.name = std::move(name);
    node.parent = parent;
    node.depth = parent < 0 ? 1 : rig_.nodes[static_cast<std::size_t>(parent)].depth + 1;
    return static_cast<std::uint32_t>(rig_.nodes.size() - 1);
  }

  /// A root with all below it; behind its name.
  engine::Result<void> read_tree() {
    std::vector<std::uint32_t> open = {add_node(std::string(words_.rest_of_line()), -1)};
    if (words_.next() != "{") return wrong("{");
    while (!open.empty()) {
      const std::string_view word = words_.next();
      if (word == "}") {
        open.pop_back();
        continue;
      }
      if (auto read = read_entry(word, open); !read) return read;
    }
    return {};
  }

  /// Reads an offset, channels, or a joint on it, all of the joint that was opened last.
  engine::Result<void> read_entry(std::string_view word, std::vector<std::uint32_t>& open) {
    if (word == "OFFSET") return read_offset(open.back());
    if (word == "CHANNELS") return read_channels(open.back());
    if (word != "JOINT" && word != "End") return wrong("OFFSET, CHANNELS, JOINT, End Site or }");
    if (open.size() >= kMaxNodeDepth || rig_.nodes.size() >= rig::kMaxJoints)
      return wrong("the end of the hierarchy, which is too large,");
    const std::string name(words_.rest_of_line());
    const std::string parent = rig_.nodes[open.back()].name;
    open.push_back(add_node(word == "End" ? parent + "_end" : name, static_cast<std::int32_t>(open.back())));
    if (words_.next() != "{") return wrong("{");
    return {};
  }

  engine::Result<void> read_offset(std::uint32_t node) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto value = words_.number();
      if (!value) return wrong("three finite numbers behind OFFSET");
      rig_.nodes[node].local(k, 3) = *value;
    }
    return {};
  }

  engine::Result<void> read_channels(std::uint32_t node) {
    NodeChannels channels{node, rig::Vec3::Zero(), {}};
    const auto count = words_.number();
    if (!count || *count < 0.0 || *count > 6.0) return wrong("a number of channels from 0 to 6");
    for (int k = 0; k < static_cast<int>(*count); ++k) {
      const auto channel = channel_of(words_.next());
      if (!channel) return wrong("channels such as Xposition or Zrotation");
      channels.channels.push_back(*channel);
    }
    if (!channels.channels.empty()) table_.push_back(std::move(channels));
    return {};
  }

  engine::Result<void> read_motion() {
    if (words_.next() != "Frames:") return wrong("Frames:");
    const auto frames = words_.number();
    if (!frames || !(*frames >= 1.0) || *frames > 1e9) return wrong("the number of frames, 1 or more");
    if (words_.next() != "Frame" || words_.next() != "Time:") return wrong("Frame Time:");
    const auto frame_s = words_.number();
    if (!frame_s || !(*frame_s > 0.0)) return wrong("the time of a frame, more than 0 seconds");
    FileClip& clip = rig_.clips.emplace_back();
    clip.name = file_.stem().string();
    clip.duration_s = (std::floor(*frames) - 1.0) * *frame_s;
    for (NodeChannels& channels : table_) {
      channels.offset = rig_.nodes[channels.node].local.topRightCorner<3, 1>();
      clip.tracks.emplace_back(channels.node, rig::Track{});
    }
    for (std::size_t f = 0; f < static_cast<std::size_t>(*frames); ++f)
      for (std::size_t i = 0; i < table_.size(); ++i)
        if (!read_row(table_[i], static_cast<double>(f) * *frame_s, clip.tracks[i].second))
          return wrong("a finite number for each channel: frame " + std::to_string(f + 1) + " of " +
                       std::to_string(static_cast<std::size_t>(*frames)) + " is not whole, it");
    return {};
  }

  bool read_row(const NodeChannels& channels, double time_s, rig::Track& track) {
    rig::Vec3 position = channels.offset;
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    bool moves = false, turns = false;
    for (const Channel channel : channels.channels) {
      const auto value = words_.number();
      if (!value) return false;
      const auto k = static_cast<int>(channel);
      if (k < 3) {
        position[k] = *value;
        moves = true;
      } else {
        rotation = rotation * Eigen::AngleAxisd(*value * std::numbers::pi / 180.0, rig::Vec3::Unit(k - 3));
        turns = true;
      }
    }
    if (moves) {
      track.translation.time_s.push_back(time_s);
      track.translation.value.push_back(position);
    }
    if (turns) {
      track.rotation.time_s.push_back(time_s);
      track.rotation.value.push_back(rotation.normalized());
    }
    return true;
  }

  Words words_;
  const std::filesystem::path& file_;
  FileRig rig_;
  std::vector<NodeChannels> table_;  // in the order of the file, which is that of the numbers in a row
};

}  // namespace

engine::Result<FileRig> read_bvh(const std::filesystem::path& file) {
  if (auto checked = check_readable(file); !checked) return checked.error();
  const std::string text = read_text(file);
  return BvhReader(text, file).read();
}

}  // namespace bodice::io
