#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// Fuzz targets: each gives any bytes to one of the functions that read what strangers can send. Files in
/// corpus/NAME are inputs of the target NAME. libFuzzer runs one target (libfuzzer_main.cpp), and
/// fuzz_corpus_test runs all of them on their corpora.
namespace capstan::fuzz {

/// A target by its name.
struct Target {
  std::string name;
  std::function<void(std::string_view bytes)> run;
};

/// All targets that are linked.
std::vector<Target>& targets();
bool addTarget(std::string name, std::function<void(std::string_view bytes)> run);

/// Does `work`. A base::InputError is the right answer to a bad input, if it names the input and the reason;
/// any other exception, and an error without these, is passed on or aborts.
void allowInputError(const std::function<void()>& work);

/// Aborts, with the condition, if a result contradicts the interface of the function under test.
void require(bool holds, const char* what);

/// A file in a folder of this process, which the next file with this name replaces.
std::filesystem::path fileOf(std::string_view bytes, const std::string& name);
/// That folder, empty.
std::filesystem::path emptyFolder();

/// Parts of an input: the bytes between lines "====", for targets that read several texts.
std::vector<std::string> partsOf(std::string_view bytes, std::size_t count);

}  // namespace capstan::fuzz

/// Defines the target NAME, whose input is `bytes`: CAPSTAN_FUZZ_TARGET(name) { … }
#define CAPSTAN_FUZZ_TARGET(NAME)                                                                        \
  static void fuzz_##NAME(std::string_view bytes);                                                       \
  [[maybe_unused]] static const bool fuzz_##NAME##_added = capstan::fuzz::addTarget(#NAME, fuzz_##NAME); \
  static void fuzz_##NAME(std::string_view bytes)
