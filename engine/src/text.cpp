#include <bodice/engine/text.hpp>

#include <array>
#include <charconv>

namespace bodice::inline v0_1::engine {

void append_number(std::string& text, double value, int digits) {
  std::array<char, 32> number;
  const auto [end, error] =
      std::to_chars(number.data(), number.data() + number.size(), value, std::chars_format::general, digits);
  if (error == std::errc()) text.append(number.data(), end);
}

std::string hex64(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t i = 0; i < text.size(); ++i)
    text[text.size() - 1 - i] = "0123456789abcdef"[(value >> (4 * i)) & 15];
  return text;
}

}  // namespace bodice::engine
