#pragma once

/// Shaders of the monitor (GLSL 3.30). `rows`: −1 all; 0 even, 1 odd rows of the display only. `grey`: for
/// red and cyan glasses, 1 if both eyes are to see brightness alone.
namespace capstan::monitor {

inline constexpr const char* kImageVertex = R"(#version 330 core
uniform vec2 window;
uniform vec4 rect;
out vec2 at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  at = corner;
  vec2 pixel = rect.xy + corner * rect.zw;
  gl_Position = vec4(2.0 * pixel.x / window.x - 1.0, 1.0 - 2.0 * pixel.y / window.y, 0.0, 1.0);
})";

inline constexpr const char* kImageFragment = R"(#version 330 core
uniform sampler2D image;
uniform float light;
uniform int rows, grey;
uniform float top;
in vec2 at;
out vec4 colour;
void main() {
  if (rows >= 0 && (int(top - gl_FragCoord.y) & 1) != rows) discard;
  vec3 seen = texture(image, at).rgb;
  if (grey == 1) seen = vec3(dot(seen, vec3(0.299, 0.587, 0.114)));
  colour = vec4(light * seen, 1.0);
})";

inline constexpr const char* kSketchVertex = R"(#version 330 core
layout(location = 0) in vec2 pixel;
layout(location = 1) in vec2 texel;
layout(location = 2) in vec4 given;
uniform vec2 window, atlas_size;
out vec2 at;
out vec4 tint;
void main() {
  at = texel / atlas_size;
  tint = given;
  gl_Position = vec4(2.0 * pixel.x / window.x - 1.0, 1.0 - 2.0 * pixel.y / window.y, 0.0, 1.0);
})";

inline constexpr const char* kSketchFragment = R"(#version 330 core
uniform sampler2D atlas;
uniform int rows, grey;
uniform float top;
in vec2 at;
in vec4 tint;
out vec4 colour;
void main() {
  if (rows >= 0 && (int(top - gl_FragCoord.y) & 1) != rows) discard;
  vec3 seen = tint.rgb;
  if (grey == 1) seen = vec3(min(1.0, 1.6 * max(max(seen.r, seen.g), seen.b)));  // the palette's darkest is white
  colour = vec4(seen, tint.a * texture(atlas, at).r);
})";

}  // namespace capstan::monitor
