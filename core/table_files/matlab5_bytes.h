#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>

/// Bytes of MATLAB files of version 5, for core/table_files only.
namespace capstan::table_files {

/// Throws base::InputError: the file is damaged.
[[noreturn]] void refuseDamagedMatlab(const std::string& file);

/// Bytes that are read once, in order. Reading or skipping beyond their end throws base::InputError.
class MatlabBytes {
 public:
  virtual ~MatlabBytes() = default;
  virtual void read(void* to, std::size_t count) = 0;
  /// Number of bytes read and skipped so far.
  std::uint64_t position() const { return position_; }
  void skip(std::uint64_t count);

 protected:
  std::uint64_t position_ = 0;
};

/// `size` bytes of a file from `begin` on.
class FileBytes final : public MatlabBytes {
 public:
  FileBytes(const std::string& file, std::uint64_t begin, std::uint64_t size);
  void read(void* to, std::size_t count) override;
  std::uint64_t left() const { return size_ - position_; }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::ifstream in_;
  std::uint64_t size_;
};

/// The bytes that zlib compressed into such a part of a file. Holds 64 KiB of it at a time.
class InflatedBytes final : public MatlabBytes {
 public:
  explicit InflatedBytes(FileBytes compressed);
  ~InflatedBytes() override;
  void read(void* to, std::size_t count) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace capstan::table_files
