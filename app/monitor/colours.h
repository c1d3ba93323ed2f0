#pragma once

/// Colours of Okabe and Ito, as in the window: colour-blind eyes distinguish them.
namespace capstan::monitor {

struct Colour {
  float r, g, b, a = 1.0F;
  constexpr Colour faded(float alpha) const { return {r, g, b, alpha}; }
};

constexpr Colour rgb(unsigned hex) {
  const auto part = [hex](unsigned shift) { return static_cast<float>((hex >> shift) & 0xFFU) / 255.0F; };
  return {part(16), part(8), part(0)};
}

inline constexpr Colour kUkf =
    rgb(0x009E73);  ///< bluish green: the estimate, while the cameras see the marker
inline constexpr Colour kCamera = rgb(0x56B4E9);   ///< sky blue: the detected circle
inline constexpr Colour kWarning = rgb(0xE69F00);  ///< amber: the estimate without the cameras
inline constexpr Colour kFault = rgb(0xCC79A7);    ///< reddish purple
inline constexpr Colour kQuiet = rgb(0xA8A8A8);    ///< nothing to see
inline constexpr Colour kText = rgb(0xF2F2F2);
inline constexpr Colour kMuted = rgb(0xB4B4B4);
inline constexpr Colour kBlack = rgb(0x000000);

}  // namespace capstan::monitor
