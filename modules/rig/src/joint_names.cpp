#include "joint_names.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>

#include <bodice/rig/retarget.hpp>

namespace bodice::inline v0_1::rig {

namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}
bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// "LeftUpLeg" and "left_up.leg" are left, up, leg; "LThigh" is l, thigh; digits stand alone.
std::vector<std::string> words_of(std::string_view name) {
  if (const std::size_t colon = name.rfind(':'); colon != std::string_view::npos)
    name.remove_prefix(colon + 1);
  std::vector<std::string> words;
  bool fresh = true;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!is_upper(c) && !is_lower(c) && !is_digit(c)) {
      fresh = true;
      continue;
    }
    const char before = i > 0 ? name[i - 1] : ' ', after = i + 1 < name.size() ? name[i + 1] : ' ';
    if (is_upper(c) && (is_lower(before) || (is_upper(before) && is_lower(after)))) fresh = true;
    if (i > 0 && is_digit(c) != is_digit(before)) fresh = true;
    if (fresh || words.empty()) words.emplace_back();
    fresh = false;
    words.back().push_back(lower(c));
  }
  return words;
}

/// Marks of conventions that say nothing about the joint.
bool is_mark(const std::string& word) {
  static constexpr std::string_view kMarks[] = {"mixamorig", "bip", "def", "org",  "mch",       "cc",
                                                "base",      "j",   "jnt", "bone", "character", "armature",
                                                "human",     "c",   "f",   "b"};
  return std::find(std::begin(kMarks), std::end(kMarks), word) != std::end(kMarks);
}

struct Words {
  std::string core;                  ///< letters without side and marks
  std::vector<std::string> numbers;  ///< without leading zeros
  char side = 0;                     ///< l, r or 0
};

Words sort_words(std::string_view name) {
  Words sorted;
  bool after_mark = false;
  for (const std::string& word : words_of(name)) {
    if (is_digit(word[0])) {
      const std::size_t first = std::min(word.find_first_not_of('0'), word.size() - 1);
      if (!(after_mark && sorted.core.empty())) sorted.numbers.push_back(word.substr(first));  // Bip01
    } else if (word == "left" || word == "l") {
      sorted.side = 'l';
    } else if (word == "right" || word == "r") {
      sorted.side = 'r';
    } else if (!is_mark(word)) {
      sorted.core += word;
    }
    after_mark = is_mark(word);
  }
  return sorted;
}

struct Synonym {
  std::string_view word, common;
};

constexpr Synonym kSided[] = {
    {"upleg", "thigh"},        {"upperleg", "thigh"},  {"thigh", "thigh"},         {"hip", "thigh"},
    {"leg", "calf"},           {"lowerleg", "calf"},   {"calf", "calf"},           {"shin", "calf"},
    {"knee", "calf"},          {"lowleg", "calf"},     {"foot", "foot"},           {"ankle", "foot"},
    {"toebase", "toes"},       {"toe", "toes"},        {"toes", "toes"},           {"ball", "toes"},
    {"clavicle", "collar"},    {"collar", "collar"},   {"shoulder", "shoulder"},   {"shldr", "upperarm"},
    {"shldrbend", "upperarm"}, {"thighbend", "thigh"}, {"forearmbend", "forearm"}, {"arm", "upperarm"},
    {"upperarm", "upperarm"},  {"uparm", "upperarm"},  {"forearm", "forearm"},     {"lowerarm", "forearm"},
    {"elbow", "forearm"},      {"lowarm", "forearm"},  {"hand", "hand"},           {"wrist", "hand"},
};
constexpr Synonym kMiddle[] = {{"hips", "hips"}, {"hip", "hips"},  {"pelvis", "hips"},
                               {"root", "root"}, {"neck", "neck"}, {"head", "head"}};
constexpr Synonym kFingers[] = {{"thumb", "thumb"}, {"index", "index"}, {"middle", "middle"},
                                {"mid", "middle"},  {"ring", "ring"},   {"pinky", "pinky"},
                                {"little", "pinky"}};
constexpr std::string_view kFingerOfNumber[] = {"thumb", "index", "middle", "ring", "pinky"};

template <std::size_t N>
std::string_view find(const Synonym (&table)[N], std::string_view word) {
  for (const Synonym& synonym : table)
    if (synonym.word == word) return synonym.common;
  return {};
}

/// "handindex" and "index" with a number are a finger's bone; "finger" with two numbers is finger and bone.
std::string finger_of(const Words& words) {
  std::string_view core = words.core;
  if (core.starts_with("hand")) core.remove_prefix(4);
  if (core == "finger" && words.numbers.size() == 2 && words.numbers[0].size() == 1 &&
      words.numbers[0] >= "1" && words.numbers[0] <= "5")
    return std::string(kFingerOfNumber[words.numbers[0][0] - '1']) + '_' + words.numbers[1];
  const std::string_view finger = find(kFingers, core);
  if (finger.empty() || words.numbers.size() != 1) return "";
  return std::string(finger) + '_' + words.numbers[0];
}

std::string in_lower_case(std::string_view name) {
  std::string text(name.substr(name.rfind(':') + 1));  // all of it where there is no colon
  std::transform(text.begin(), text.end(), text.begin(), lower);
  return text;
}

}  // namespace

std::string common_joint_name(std::string_view name) {
  const Words words = sort_words(name);
  if (words.side == 0) {
    const bool first = words.numbers.empty() || words.numbers.front() == "0" || words.numbers.front() == "1";
    const std::string_view common = find(kMiddle, words.core);
    return common.empty() || !first ? in_lower_case(name) : std::string(common);
  }
  const std::string side = std::string("_") + words.side;
  if (const std::string finger = finger_of(words); !finger.empty()) return finger + side;
  const bool first = words.numbers.empty() ||
                     (words.numbers.size() == 1 && (words.numbers[0] == "0" || words.numbers[0] == "1"));
  const std::string_view common = find(kSided, words.core);
  return common.empty() || !first ? in_lower_case(name) : std::string(common) + side;
}

std::vector<std::string> common_joint_names(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(common_joint_name(joint.name));
  const std::set<std::string> all(names.begin(), names.end());
  std::set<std::string> taken;
  for (std::string& name : names) {
    if (name == "root" && !all.contains("hips")) name = "hips";
    for (const std::string side : {"_l", "_r"}) {
      if (name != "shoulder" + side) continue;
      if (!all.contains("collar" + side))
        name = "collar" + side;
      else if (!all.contains("upperarm" + side))
        name = "upperarm" + side;
    }
    if (!taken.insert(name).second) name.clear();
  }
  return names;
}

}  // namespace bodice::rig
