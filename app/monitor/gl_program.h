#pragma once

#include <epoxy/gl.h>

namespace capstan::monitor {

/// A vertex and a fragment shader, linked. Throws std::runtime_error with the driver's message.
class GlProgram {
 public:
  GlProgram(const char* vertex, const char* fragment);
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  void use() const { glUseProgram(program_); }
  void set(const char* name, int value) const { glUniform1i(glGetUniformLocation(program_, name), value); }
  void set(const char* name, float value) const { glUniform1f(glGetUniformLocation(program_, name), value); }
  void set(const char* name, float x, float y) const {
    glUniform2f(glGetUniformLocation(program_, name), x, y);
  }
  void set(const char* name, float x, float y, float z, float w) const {
    glUniform4f(glGetUniformLocation(program_, name), x, y, z, w);
  }

 private:
  GLuint program_ = 0;
};

}  // namespace capstan::monitor
