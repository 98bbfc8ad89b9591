#include "options/validators.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include <bodice/body/proportions.hpp>

namespace bodice::inline v0_1::cli {
namespace {

template <class Accepts>
CLI::Validator number(const std::string& what, const std::string& shown, Accepts accepts) {
  auto judge = [what, accepts](const std::string& text) {
    double value = 0.0;
    const bool is_number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
    return is_number && accepts(value) ? std::string() : "'" + text + "' is not " + what;
  };
  return CLI::Validator(judge, shown);
}

template <class Number>
std::string range(Number low, Number high, const char* to) {
  std::ostringstream text;
  text << low << to << high;
  return text.str();
}

}  // namespace

CLI::Validator finite() {
  return number("a finite number", "", [](double) { return true; });
}

CLI::Validator above_zero() {
  return number("a number above 0", "positive", [](double value) { return value > 0.0; });
}

CLI::Validator zero_or_more() {
  return number("a number of at least 0", "non-negative", [](double value) { return value >= 0.0; });
}

CLI::Validator between(double low, double high) {
  return number("a number from " + range(low, high, " to "), range(low, high, ".."),
                [low, high](double value) { return value >= low && value <= high; });
}

CLI::Validator whole(std::uint64_t low, std::uint64_t high) {
  auto judge = [low, high](const std::string& text) {
    std::uint64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    const bool octal = text.size() > 1 && text.front() == '0';  // for programs that read it later
    if (!octal && read.ec == std::errc() && read.ptr == end && value >= low && value <= high)
      return std::string();
    return "'" + text + "' is not a whole number from " + range(low, high, " to ");
  };
  return CLI::Validator(judge, range(low, high, ".."));
}

CLI::Validator not_empty(const std::string& remedy) {
  return CLI::Validator(
      [remedy](const std::string& text) { return text.empty() ? "it is empty: " + remedy : std::string(); },
      "");
}

CLI::Validator profile() {
  auto judge = [](const std::string& text) {
    std::string names;
    for (const std::string& name : body::profile_names()) {
      if (text == name) return std::string();
      names += name + ", ";
    }
    std::error_code ignored;
    if (text.ends_with(".json") || std::filesystem::exists(text, ignored)) return std::string();
    return "'" + text + "' is not " + names + "or a JSON file";
  };
  return CLI::Validator(judge, "");
}

}  // namespace bodice::cli
