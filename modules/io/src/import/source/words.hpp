// Words of text formats.
#pragma once

#include <algorithm>
#include <string_view>

namespace bodice::inline v0_1::io {

inline constexpr std::string_view kBlanks = " \t\r\n";

/// Takes the first word off a line; empty where none is left.
inline std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

}  // namespace bodice::io
