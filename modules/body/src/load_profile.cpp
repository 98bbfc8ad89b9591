// A custom profile has the form {"name": "...", "female": {"upper_arm": 0.19, ...}, "male": {...}}. Every
// measure of kMeasures is present in both, as a fraction of the stature.
#include <fstream>
#include <iterator>

#include <bodice/body/proportions.hpp>
#include <bodice/engine/json.hpp>
#include <bodice/engine/message.hpp>

#include "profiles.hpp"

namespace bodice::inline v0_1::body {
namespace {

using engine::SortedJson;

/// An Error that is thrown, so that the reading code needs no checks between its steps.
struct BadProfile {
  engine::Error error;
};

[[noreturn]] void fail(engine::ErrorCode code, std::string message, std::string remedy) {
  throw BadProfile{{code, std::move(message), std::move(remedy)}};
}

Proportions read_sex(const SortedJson& root, const char* sex, const std::string& file) {
  if (!root.contains(sex) || !root[sex].is_object())
    fail(engine::ErrorCode::kUnreadable, file + ": the object '" + sex + "' is missing.",
         "Give 'female' and 'male', each with all 15 ratios to stature.");
  const SortedJson& table = root[sex];
  Proportions result;
  for (const Measure& m : kMeasures) {
    const std::string where = file + ": " + sex + "." + m.name;
    if (!table.contains(m.name) || !table[m.name].is_number())
      fail(engine::ErrorCode::kUnreadable, where + " is missing or not a number.",
           "Give every measure as a ratio to stature.");
    const double value = table[m.name].get<double>();
    if (!(value >= m.least && value <= m.most))
      fail(engine::ErrorCode::kInvalidArgument, engine::message(where, " = ", value, " is implausible."),
           engine::message("Expected a ratio to stature between ", m.least, " and ", m.most, "."));
    result.*m.ratio = value;
  }
  return result;
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    fail(engine::ErrorCode::kNotFound, "Cannot open the proportion profile " + file.string() + ".",
         "Check the path, or give the name of a built-in profile.");
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

engine::Result<ProportionProfile> load_profile(const std::filesystem::path& file) {
  try {
    const std::string shown = file.string();
    const SortedJson root = SortedJson::parse_or_null(read_text(file));
    if (!root.is_object())
      fail(engine::ErrorCode::kUnreadable, shown + " is not a JSON object.",
           "Write one object with 'name', 'female' and 'male'.");
    ProportionProfile profile;
    profile.name = root.contains("name") && root["name"].is_string() ? root["name"].get<std::string>()
                                                                     : file.stem().string();
    profile.female = read_sex(root, "female", shown);
    profile.male = read_sex(root, "male", shown);
    return profile;
  } catch (const BadProfile& bad) {
    return bad.error;
  }
}

}  // namespace bodice::body
