#pragma once

#include <hdf5.h>

#include <filesystem>
#include <mutex>
#include <string>
#include <utility>

/// HDF5's C interface with owning classes. For core/table_files only.
namespace capstan::table_files {

/// An identifier of the HDF5 library, closed by its own function.
class Hdf5Id {
 public:
  Hdf5Id() = default;
  Hdf5Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_), std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Id() {
    if (id_ >= 0) close_(id_);
  }
  bool isOpen() const { return id_ >= 0; }
  hid_t get() const { return id_; }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// While it lives, this thread alone uses HDF5 (and matio, which uses it), and HDF5 prints no errors.
class Hdf5Lock {
 public:
  Hdf5Lock();
  ~Hdf5Lock();
  Hdf5Lock(const Hdf5Lock&) = delete;
  Hdf5Lock& operator=(const Hdf5Lock&) = delete;

 private:
  std::unique_lock<std::mutex> lock_;
  H5E_auto2_t report_ = nullptr;
  void* report_to_ = nullptr;
};

/// Variable-length UTF-8 text. Throws as all below: base::InputError when `id` cannot be written.
void writeHdf5Attribute(const Hdf5Id& id, const char* name, const std::string& value);
void writeHdf5Attribute(const Hdf5Id& id, const char* name, int value);

}  // namespace capstan::table_files
