#include "core/table_files/hdf5_file.h"

#include "core/base/error.h"

namespace capstan::table_files {
namespace {

std::mutex& oneThread() {
  static std::mutex mutex;
  return mutex;
}

void writeAttribute(const Hdf5Id& id, const char* name, hid_t type, const void* value) {
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Id attribute(H5Acreate2(id.get(), name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.isOpen() || H5Awrite(attribute.get(), type, value) < 0)
    throw base::InputError({"", 0, name, {}, "cannot be written", "Check the folder and the space"});
}

}  // namespace

Hdf5Lock::Hdf5Lock() : lock_(oneThread()) {
  H5Eget_auto2(H5E_DEFAULT, &report_, &report_to_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Lock::~Hdf5Lock() { H5Eset_auto2(H5E_DEFAULT, report_, report_to_); }

void writeHdf5Attribute(const Hdf5Id& id, const char* name, const std::string& value) {
  const Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  const char* text = value.c_str();
  writeAttribute(id, name, type.get(), static_cast<const void*>(&text));
}

void writeHdf5Attribute(const Hdf5Id& id, const char* name, int value) {
  writeAttribute(id, name, H5T_NATIVE_INT, &value);
}

}  // namespace capstan::table_files
