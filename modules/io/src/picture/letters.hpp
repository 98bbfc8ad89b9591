// Words in pictures: a few characters, drawn as dots.
#pragma once

#include <string_view>

#include "png.hpp"

namespace bodice::inline v0_1::io {

/// Dots of a character with the gap to the next one, and of a line of text.
inline constexpr int kLetterWidth = 6, kLetterHeight = 9;

/// The width of a text in pixels, `dot` pixels a dot.
int text_width(std::string_view text, int dot);

/// Draws a text in dark gray with its upper left corner at x, y: digits, lower-case letters, '.' and '-'.
/// Other characters are left blank, and what lies outside of the image is cut.
void draw_text(std::string_view text, int x, int y, int dot, Image& image);

}  // namespace bodice::io
