#include "app/monitor/font.h"

#include <fontconfig/fontconfig.h>
#include <ft2build.h>

#include <algorithm>
#include <memory>
#include <string>
#include FT_FREETYPE_H

#include "core/base/error.h"

namespace capstan::monitor {

namespace {

constexpr int kAtlasWidth = 1024;
constexpr std::u32string_view kBeyondLatin = U"…–—−±σ×→←↑↓°²•≥≤";

[[noreturn]] void refuse(const std::string& face) {
  throw base::InputError({{}, 0, "font", face, "cannot be drawn", "Install fonts-dejavu-core"});
}

/// File of the system's font that fits `face` best.
std::string fileOf(const std::string& face) {
  using Pattern = std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)>;
  const Pattern asked(FcNameParse(reinterpret_cast<const FcChar8*>(face.c_str())), FcPatternDestroy);
  if (!asked || !FcInit()) refuse(face);
  FcConfigSubstitute(nullptr, asked.get(), FcMatchPattern);
  FcDefaultSubstitute(asked.get());
  FcResult result = FcResultMatch;
  const Pattern best(FcFontMatch(nullptr, asked.get(), &result), FcPatternDestroy);
  FcChar8* file = nullptr;
  if (!best || FcPatternGetString(best.get(), FC_FILE, 0, &file) != FcResultMatch) refuse(face);
  return reinterpret_cast<const char*>(file);
}

std::u32string characters() {
  std::u32string all;
  for (char32_t c = 0x20; c < 0x7F; ++c) all += c;
  for (char32_t c = 0xA0; c < 0x100; ++c) all += c;
  return all + std::u32string(kBeyondLatin);
}

/// Puts glyphs beside each other in rows of the atlas.
class Packer {
 public:
  explicit Packer(FontAtlas& atlas) : atlas_(atlas) {
    atlas_.width = kAtlasWidth;
    grow(4);
    for (int y = 0; y < 3; ++y) std::fill_n(atlas_.texels.begin() + y * kAtlasWidth, 3, std::uint8_t{255});
    x_ = 4, row_ = 4;
  }

  void add(const FT_Bitmap& bitmap, Glyph& glyph) {
    const int width = static_cast<int>(bitmap.width), height = static_cast<int>(bitmap.rows);
    if (x_ + width + 1 > kAtlasWidth) x_ = 0, y_ += row_ + 1, row_ = 0;
    row_ = std::max(row_, height);
    grow(y_ + row_ + 1);
    for (int line = 0; line < height; ++line)
      std::copy_n(bitmap.buffer + line * bitmap.pitch, width,
                  atlas_.texels.begin() + (y_ + line) * kAtlasWidth + x_);
    glyph.x = x_, glyph.y = y_, glyph.width = width, glyph.height = height;
    x_ += width + 1;
  }

 private:
  void grow(int height) {
    atlas_.height = std::max(atlas_.height, height);
    atlas_.texels.resize(static_cast<std::size_t>(atlas_.height) * kAtlasWidth);
  }
  FontAtlas& atlas_;
  int x_ = 0, y_ = 0, row_ = 0;
};

void draw(FT_Library library, const std::string& face_name, int pixels, Packer& packer, Font& font) {
  FT_Face opened = nullptr;
  if (FT_New_Face(library, fileOf(face_name).c_str(), 0, &opened) != 0) refuse(face_name);
  const std::unique_ptr<FT_FaceRec_, decltype(&FT_Done_Face)> face(opened, FT_Done_Face);
  if (FT_Set_Pixel_Sizes(face.get(), 0, static_cast<FT_UInt>(pixels)) != 0) refuse(face_name);
  font.pixels = pixels;
  for (const char32_t character : characters()) {
    const FT_UInt index = FT_Get_Char_Index(face.get(), character);
    if (index == 0 || FT_Load_Glyph(face.get(), index, FT_LOAD_RENDER) != 0) continue;
    const FT_GlyphSlot slot = face->glyph;
    Glyph glyph;
    glyph.left = slot->bitmap_left;
    glyph.top = slot->bitmap_top;
    glyph.advance = static_cast<float>(slot->advance.x) / 64.0F;
    packer.add(slot->bitmap, glyph);
    font.glyphs[character] = glyph;
  }
  if (font.glyphs.empty()) refuse(face_name);
}

}  // namespace

char32_t takeCharacter(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  const std::size_t length = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 0;
  if (length == 0 || length > text.size()) {
    text.remove_prefix(1);
    return U'?';
  }
  char32_t character = length == 1 ? lead : lead & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) {
      text.remove_prefix(1);
      return U'?';
    }
    character = (character << 6) | (byte(i) & 0x3FU);
  }
  text.remove_prefix(length);
  return character;
}

const Glyph& Font::glyph(char32_t character) const {
  static const Glyph kNone;
  auto found = glyphs.find(character);
  if (found == glyphs.end()) found = glyphs.find(U'?');
  return found == glyphs.end() ? kNone : found->second;
}

float Font::width(std::string_view utf8) const {
  float sum = 0.0F;
  while (!utf8.empty()) sum += glyph(takeCharacter(utf8)).advance;
  return sum;
}

std::string Font::fitted(std::string_view utf8, float most) const {
  if (width(utf8) <= most) return std::string(utf8);
  const float dots = glyph(U'…').advance;
  std::string_view rest = utf8;
  float sum = dots;
  std::size_t kept = 0;
  while (!rest.empty()) {
    sum += glyph(takeCharacter(rest)).advance;
    if (sum > most) break;
    kept = utf8.size() - rest.size();
  }
  return dots > most ? std::string() : std::string(utf8.substr(0, kept)) + "…";
}

FontAtlas makeFontAtlas(int bar_pixels, int number_pixels, int text_pixels) {
  FT_Library opened = nullptr;
  if (FT_Init_FreeType(&opened) != 0) refuse("FreeType");
  const std::unique_ptr<FT_LibraryRec_, decltype(&FT_Done_FreeType)> library(opened, FT_Done_FreeType);
  FontAtlas atlas;
  Packer packer(atlas);
  draw(library.get(), "DejaVu Sans:bold", bar_pixels, packer, atlas.bar);
  draw(library.get(), "DejaVu Sans Mono:bold", number_pixels, packer, atlas.numbers);
  draw(library.get(), "DejaVu Sans", text_pixels, packer, atlas.text);
  return atlas;
}

}  // namespace capstan::monitor
