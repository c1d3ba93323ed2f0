#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace capstan::monitor {

/// A character of an atlas. Texture coordinates and sizes in pixels.
struct Glyph {
  int x = 0, y = 0, width = 0, height = 0;  ///< in the atlas
  int left = 0, top = 0;                    ///< from the pen to the top left pixel; top is upwards
  float advance = 0.0F;
};

/// One face at one size.
struct Font {
  int pixels = 0;
  std::map<char32_t, Glyph> glyphs;
  /// The character, or a question mark for one that the face or the atlas does not have.
  const Glyph& glyph(char32_t character) const;
  float width(std::string_view utf8) const;  ///< [px]
  /// `utf8`, cut off with "…" where it is wider than `most` [px].
  std::string fitted(std::string_view utf8, float most) const;
};

/// Coverage (0…255) of the characters of all fonts in one picture. Texel (0, 0) is full: for shapes.
struct FontAtlas {
  Font bar;      ///< words of the state, bold
  Font numbers;  ///< digits of one width, bold
  Font text;     ///< help and remarks
  int width = 0, height = 0;
  std::vector<std::uint8_t> texels;
};

/// Draws DejaVu Sans, or what the system has instead, at the sizes [px]. Throws base::InputError if the
/// system has no font.
FontAtlas makeFontAtlas(int bar_pixels, int number_pixels, int text_pixels);

/// Next character of UTF-8; removes it from `text`. A byte that is no UTF-8 reads as a question mark.
char32_t takeCharacter(std::string_view& text);

}  // namespace capstan::monitor
