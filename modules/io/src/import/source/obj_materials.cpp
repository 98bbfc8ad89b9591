// Based on: Ramey, Rose, Tyerman. MTL material format (Lightwave, OBJ). 1995. - mtllib, and options of maps
#include "import/source/obj_materials.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "import/source/input_file.hpp"
#include "import/source/words.hpp"

namespace bodice::inline v0_1::io {

namespace {

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

/// Calls use(first word, rest) for each line that is not empty.
template <class Use>
void each_line(std::string_view text, Use use) {
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::string_view word = take_word(line);
    if (!word.empty()) use(word, trimmed(line));
  }
}

bool is_decimal(std::string_view word) {
  return !word.empty() && word.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
}

/// What is left of a line of a map after its options, some of which take up to three numbers.
std::string_view without_options(std::string_view rest) {
  for (;;) {
    std::string_view after = rest;
    const std::string_view option = take_word(after);
    if (!option.starts_with('-') || is_decimal(option)) return trimmed(rest);
    if (option == "-o" || option == "-s" || option == "-t" || option == "-mm") {
      std::string_view next = after;
      for (int k = 0; k < 3 && is_decimal(take_word(next)); ++k) after = next;
    } else {
      take_word(after);
    }
    rest = after;
  }
}

bool is_map(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower.starts_with("map_") || lower == "bump" || lower == "norm" || lower == "disp" ||
         lower == "decal" || lower == "refl";
}

}  // namespace

std::vector<std::filesystem::path> material_libraries(const std::filesystem::path& obj) {
  std::vector<std::filesystem::path> files;
  each_line(read_text(obj), [&](std::string_view word, std::string_view rest) {
    if (word == "mtllib" && !rest.empty()) files.push_back(obj.parent_path() / std::string(rest));
  });
  return files;
}

std::vector<std::string> images_of_library(const std::filesystem::path& library) {
  std::vector<std::string> images;
  std::error_code error;  // a device or a pipe has no end
  if (!std::filesystem::is_regular_file(library, error)) return images;
  each_line(read_text(library), [&](std::string_view word, std::string_view rest) {
    const std::string_view name = is_map(word) ? without_options(rest) : std::string_view();
    if (!name.empty()) images.emplace_back(name);
  });
  return images;
}

}  // namespace bodice::io
