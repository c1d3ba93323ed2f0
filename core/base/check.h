#pragma once

/// Invariants: what a caller of ours must have seen to. A broken one is a defect of the program, so it names
/// condition and place on standard error and aborts. Wrong input of a person is base::InputError instead.
///
/// CAPSTAN_CHECK(condition)   in every build: for constructors and set-up, where it costs nothing per sample.
/// CAPSTAN_ASSERT(condition)  per sample or per element: in every build but those of packages, which the
///                            CMake option CAPSTAN_ASSERTIONS=OFF makes. NDEBUG has no say.
namespace capstan::base {

[[noreturn]] void failCheck(const char* condition, const char* file, int line, const char* function) noexcept;

}  // namespace capstan::base

#define CAPSTAN_CHECK(...) \
  ((__VA_ARGS__) ? void() : ::capstan::base::failCheck(#__VA_ARGS__, __FILE__, __LINE__, __func__))

#ifdef CAPSTAN_NO_ASSERTIONS
#define CAPSTAN_ASSERT(...) static_cast<void>(sizeof(!(__VA_ARGS__)))
#else
#define CAPSTAN_ASSERT(...) CAPSTAN_CHECK(__VA_ARGS__)
#endif
