#include "app/monitor/painter.h"

#include <cstddef>
#include <opencv2/imgproc.hpp>

#include "app/monitor/shaders.h"

namespace capstan::monitor {

Painter::Painter()
    : image_program_(kImageVertex, kImageFragment), sketch_program_(kSketchVertex, kSketchFragment) {
  glGenVertexArrays(1, &image_array_);  // corners come from gl_VertexID
  glGenVertexArrays(1, &sketch_array_);
  glGenBuffers(1, &sketch_buffer_);
  glBindVertexArray(sketch_array_);
  glBindBuffer(GL_ARRAY_BUFFER, sketch_buffer_);
  const auto attribute = [](GLuint index, GLint size, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                          reinterpret_cast<const void*>(offset));
  };
  attribute(0, 2, offsetof(Vertex, x));
  attribute(1, 2, offsetof(Vertex, u));
  attribute(2, 4, offsetof(Vertex, r));
  for (Texture& texture : textures_) glGenTextures(1, &texture.name);
  glGenTextures(1, &atlas_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

Painter::~Painter() {
  for (const Texture& texture : textures_) glDeleteTextures(1, &texture.name);
  glDeleteTextures(1, &atlas_);
  glDeleteBuffers(1, &sketch_buffer_);
  glDeleteVertexArrays(1, &sketch_array_);
  glDeleteVertexArrays(1, &image_array_);
}

void Painter::setImage(std::size_t eye, const cv::Mat& image) {
  Texture& texture = textures_[eye];
  if (image.empty()) {
    texture.size = {};
    return;
  }
  glBindTexture(GL_TEXTURE_2D, texture.name);
  const bool grey = image.channels() == 1;
  const GLenum format = grey ? GL_RED : GL_BGR;
  if (texture.size != image.size() || texture.channels != image.channels()) {
    glTexImage2D(GL_TEXTURE_2D, 0, grey ? GL_R8 : GL_RGB8, image.cols, image.rows, 0, format,
                 GL_UNSIGNED_BYTE, image.data);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_G, grey ? GL_RED : GL_GREEN);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_B, grey ? GL_RED : GL_BLUE);
    for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
      glTexParameteri(GL_TEXTURE_2D, side, GL_CLAMP_TO_EDGE);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    texture.size = image.size();
    texture.channels = image.channels();
  } else {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.cols, image.rows, format, GL_UNSIGNED_BYTE, image.data);
  }
}

void Painter::setAtlas(const FontAtlas& atlas) {
  glBindTexture(GL_TEXTURE_2D, atlas_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, atlas.width, atlas.height, 0, GL_RED, GL_UNSIGNED_BYTE,
               atlas.texels.data());
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  atlas_width_ = atlas.width;
  atlas_height_ = atlas.height;
}

void Painter::begin(int width, int height, int first_row) {
  width_ = width;
  height_ = height;
  first_row_ = first_row;
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  mix(Mix::kNone);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
}

void Painter::mix(Mix mix) {
  mix_ = mix;
  glColorMask(mix != Mix::kCyan, mix != Mix::kRed, mix != Mix::kRed, GL_TRUE);
}

void Painter::prepare(const GlProgram& program) const {
  program.use();
  program.set("window", static_cast<float>(width_), static_cast<float>(height_));
  program.set("rows", mix_ == Mix::kEvenRows ? 0 : mix_ == Mix::kOddRows ? 1 : -1);
  program.set("grey", mix_ == Mix::kRed || mix_ == Mix::kCyan ? 1 : 0);
  program.set("top",
              static_cast<float>(height_ + (first_row_ & 1)));  // so that rows count from the display's first
}

void Painter::drawImage(std::size_t eye, const Rect& rect, float light) {
  if (textures_[eye].size.empty() || rect.empty()) return;
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  prepare(image_program_);
  image_program_.set("rect", static_cast<float>(rect.x), static_cast<float>(rect.y),
                     static_cast<float>(rect.width), static_cast<float>(rect.height));
  image_program_.set("light", light);
  glBindTexture(GL_TEXTURE_2D, textures_[eye].name);
  glBindVertexArray(image_array_);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void Painter::draw(const Sketch& sketch, const Rect& clip) {
  const auto& vertices = sketch.vertices();
  if (vertices.empty() || clip.empty()) return;
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_SCISSOR_TEST);
  glScissor(clip.x, height_ - clip.y - clip.height, clip.width, clip.height);
  prepare(sketch_program_);
  sketch_program_.set("atlas_size", static_cast<float>(atlas_width_), static_cast<float>(atlas_height_));
  glBindTexture(GL_TEXTURE_2D, atlas_);
  glBindVertexArray(sketch_array_);
  glBindBuffer(GL_ARRAY_BUFFER, sketch_buffer_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
               GL_STREAM_DRAW);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
  glDisable(GL_SCISSOR_TEST);
}

cv::Mat Painter::readBack() const {
  cv::Mat picture(height_, width_, CV_8UC3);
  glReadPixels(0, 0, width_, height_, GL_BGR, GL_UNSIGNED_BYTE, picture.data);
  cv::flip(picture, picture, 0);
  return picture;
}

}  // namespace capstan::monitor
