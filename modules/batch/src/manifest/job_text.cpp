#include "manifest/job_text.hpp"

#include <cmath>
#include <utility>

#include <bodice/engine/json.hpp>

namespace bodice::inline v0_1::batch {
namespace {

using engine::Error;
using engine::ErrorCode;
using Json = engine::SortedJson;

Error unreadable(std::string message, std::string remedy) {
  return {ErrorCode::kUnreadable, std::move(message), std::move(remedy)};
}

/// The value as it would be typed. Whole numbers have no decimal point, since Python writes 30.0 for some.
std::string typed(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) {
    const double number = value.get<double>();
    if (number == std::trunc(number) && std::abs(number) < 1e15)
      return std::to_string(static_cast<long long>(number));
  }
  return value.dump();
}

bool is_plain(const Json& value) {
  return value.is_string() || value.is_number() || value.is_boolean();
}

}  // namespace

engine::Result<Job> job_from_json(std::string_view line) {
  Json json;
  try {
    json = Json::parse(line);
  } catch (const engine::JsonError&) {
    return unreadable("This line is not JSON.", "Write one JSON object a line, as {\"body\": \"a.obj\"}.");
  }
  if (!json.is_object())
    return unreadable("This line is no JSON object.", "Write one a line, as {\"body\": \"a.obj\"}.");
  Job job;
  for (const auto& [name, value] : json.items()) {
    if (value.is_null()) continue;
    std::vector<std::string>& values = job.values[name];
    bool plain = is_plain(value) || value.is_array();
    if (value.is_array()) {
      for (const Json& item : value) {
        plain = plain && is_plain(item);
        if (plain) values.push_back(typed(item));
      }
    } else if (plain) {
      values.push_back(typed(value));
    }
    if (!plain)
      return unreadable(
          "The value of '" + name + "' is neither text, a number, true, false nor a list of these.",
          "Write it as one of them.");
  }
  return job;
}

engine::Result<std::vector<std::string>> csv_fields(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"') {
      const bool doubled = quoted && i + 1 < line.size() && line[i + 1] == '"';
      if (doubled)
        fields.back() += c, ++i;
      else
        quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  if (quoted) return unreadable("A quote of this line is not closed.", "Close it; write \"\" for a quote.");
  return fields;
}

engine::Result<Job> job_from_csv(std::string_view line, const std::vector<std::string>& columns) {
  auto fields = csv_fields(line);
  if (!fields) return std::move(fields).error();
  if (fields->size() != columns.size())
    return unreadable("This line has " + std::to_string(fields->size()) +
                          " fields, and the first line names " + std::to_string(columns.size()) + " columns.",
                      "Give each column a field, empty where it is left out.");
  Job job;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& field = fields.value()[i];
    if (field.empty()) continue;
    std::vector<std::string>& values = job.values[columns[i]];
    for (std::size_t begin = 0; begin <= field.size();) {
      const std::size_t end = std::min(field.find(';', begin), field.size());
      values.push_back(field.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  return job;
}

std::string text_of(const Job& job) {
  std::string text;
  const auto add = [&text](const std::string& word) { text += std::to_string(word.size()) + ":" + word; };
  for (const auto& [name, values] : job.values) {
    add(name);
    text += "=" + std::to_string(values.size());
    for (const std::string& value : values) add(value);
  }
  return text;
}

}  // namespace bodice::batch
