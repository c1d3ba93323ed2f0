#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

#include "app/monitor/font.h"
#include "app/monitor/gl_program.h"
#include "app/monitor/layout.h"
#include "app/monitor/sketch.h"

namespace capstan::monitor {

/// Draws images and sketches with OpenGL 3.3 into the current context. Rectangles are pixels of the window,
/// from its top left corner.
class Painter {
 public:
  Painter();
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// Keeps the image of an eye (8-bit grey or BGR); an empty one removes it.
  void setImage(std::size_t eye, const cv::Mat& image);
  cv::Size imageSize(std::size_t eye) const { return textures_[eye].size; }
  void setAtlas(const FontAtlas& atlas);

  /// Begins a picture: a black window. `first_row`: row of the display on which the window begins.
  void begin(int width, int height, int first_row);
  /// How the next images and sketches are mixed with those of the other eye.
  void mix(Mix mix);
  /// The eye's image, scaled into `rect`; `light` below 1 dims it.
  void drawImage(std::size_t eye, const Rect& rect, float light);
  /// `clip`: nothing is drawn outside it.
  void draw(const Sketch& sketch, const Rect& clip);
  /// What was drawn, as 8-bit BGR.
  cv::Mat readBack() const;

 private:
  struct Texture {
    GLuint name = 0;
    cv::Size size;
    int channels = 0;
  };
  void prepare(const GlProgram& program) const;

  GlProgram image_program_, sketch_program_;
  GLuint image_array_ = 0, sketch_array_ = 0, sketch_buffer_ = 0, atlas_ = 0;
  std::array<Texture, 2> textures_;
  int atlas_width_ = 1, atlas_height_ = 1;
  int width_ = 1, height_ = 1, first_row_ = 0;
  Mix mix_ = Mix::kNone;
};

}  // namespace capstan::monitor
