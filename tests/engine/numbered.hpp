#pragma once

#include <cstdint>
#include <string>

/// The text followed by the number: the name of a task.
inline std::string numbered(std::string text, std::uint64_t number) {
  return text.append(std::to_string(number));
}
