#include "app/monitor/gl_program.h"

#include <array>
#include <stdexcept>
#include <string>

namespace capstan::monitor {

namespace {

GLuint compile(GLenum kind, const char* text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  std::array<char, 2048> message{};
  glGetShaderInfoLog(shader, message.size(), nullptr, message.data());
  throw std::runtime_error(std::string("the graphics driver refuses a shader: ") + message.data());
}

}  // namespace

GlProgram::GlProgram(const char* vertex, const char* fragment) : program_(glCreateProgram()) {
  const std::array shaders = {compile(GL_VERTEX_SHADER, vertex), compile(GL_FRAGMENT_SHADER, fragment)};
  for (const GLuint shader : shaders) glAttachShader(program_, shader);
  glLinkProgram(program_);
  for (const GLuint shader : shaders) glDeleteShader(shader);
  GLint good = 0;
  glGetProgramiv(program_, GL_LINK_STATUS, &good);
  if (!good) throw std::runtime_error("the graphics driver does not link a shader");
}

GlProgram::~GlProgram() { glDeleteProgram(program_); }

}  // namespace capstan::monitor
