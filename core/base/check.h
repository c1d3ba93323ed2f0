#pragma once

/// Checks of invariants. A broken invariant is a defect of the program: the check prints the condition and
/// its file and line on standard error and aborts. Wrong input of a person throws base::InputError instead.
///
/// CAPSTAN_CHECK(condition)   active in every build; for constructors and set-up, not for code per sample.
/// CAPSTAN_ASSERT(condition)  for code per sample or per element; off in package builds, which set the CMake
///                            option CAPSTAN_ASSERTIONS=OFF. NDEBUG has no effect on it.
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
