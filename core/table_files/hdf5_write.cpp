#include "core/table_files/hdf5_write.h"

#include "core/base/error.h"
#include "core/base/part_file.h"
#include "core/table_files/hdf5_file.h"

namespace capstan::table_files {
namespace {

constexpr hsize_t kChunk = 1U << 14;  ///< rows
constexpr unsigned kCompression = 4;  ///< of 9

struct Extent {
  Hdf5Id id;
  hsize_t rows = 0;
};

/// Makes an empty data set that can grow.
Hdf5Id makeColumn(const Hdf5Id& group, const NamedColumn& column) {
  const hsize_t none = 0, unlimited = H5S_UNLIMITED, chunk = kChunk;
  const Hdf5Id space(H5Screate_simple(1, &none, &unlimited), H5Sclose);
  const Hdf5Id how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(how.get(), 1, &chunk);
  H5Pset_shuffle(how.get());
  H5Pset_deflate(how.get(), kCompression);
  Hdf5Id made(H5Dcreate2(group.get(), column.name.c_str(), H5T_IEEE_F64LE, space.get(), H5P_DEFAULT,
                         how.get(), H5P_DEFAULT),
              H5Dclose);
  if (!made.isOpen())
    throw base::InputError({"", 0, column.name, {}, "cannot be written", "Check the folder and the space"});
  writeHdf5Attribute(made, "unit", column.unit);
  writeHdf5Attribute(made, "meaning", column.meaning);
  return made;
}

bool appendTo(Extent& extent, const std::vector<double>& values) {
  const hsize_t begin = extent.rows, count = values.size();
  if (count == 0) return true;
  extent.rows += count;
  if (H5Dset_extent(extent.id.get(), &extent.rows) < 0) return false;
  const Hdf5Id file(H5Dget_space(extent.id.get()), H5Sclose),
      memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
  return H5Sselect_hyperslab(file.get(), H5S_SELECT_SET, &begin, nullptr, &count, nullptr) >= 0 &&
         H5Dwrite(extent.id.get(), H5T_NATIVE_DOUBLE, memory.get(), file.get(), H5P_DEFAULT, values.data()) >=
             0;
}

}  // namespace

struct Hdf5Writer::State {
  explicit State(const std::filesystem::path& path) : part(path) {}
  [[noreturn]] void fail() const {
    throw base::InputError({part.target().string(),
                            0,
                            {},
                            {},
                            "cannot be written",
                            "Check the folder, its permissions and the space"});
  }

  base::PartFile part;
  Hdf5Lock lock;
  Hdf5Id file, group;
  std::vector<Extent> columns;
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path, const FileAttributes& attributes)
    : state_(std::make_unique<State>(path)) {
  base::namingFile(path.string(), [&] {
    state_->file = {H5Fcreate(state_->part.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                    H5Fclose};
    if (!state_->file.isOpen()) state_->fail();
    const Hdf5Id root(H5Gopen2(state_->file.get(), "/", H5P_DEFAULT), H5Gclose);
    for (const auto& [name, value] : attributes) writeHdf5Attribute(root, name.c_str(), value);
  });
}

Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::beginTable(const std::string& group, const std::string& meaning,
                            std::span<const NamedColumn> columns) {
  State& state = *state_;
  base::namingFile(state.part.target().string(), [&] {
    state.columns.clear();
    state.group =
        group == "/"
            ? Hdf5Id(H5Gopen2(state.file.get(), "/", H5P_DEFAULT), H5Gclose)
            : Hdf5Id(H5Gcreate2(state.file.get(), group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                     H5Gclose);
    if (!state.group.isOpen()) state.fail();
    writeHdf5Attribute(state.group, "meaning", meaning);
    for (const NamedColumn& column : columns) state.columns.push_back({makeColumn(state.group, column), 0});
  });
}

void Hdf5Writer::append(std::span<const NamedColumn> columns) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (!appendTo(state_->columns[i], *columns[i].values)) state_->fail();
}

void Hdf5Writer::commit() {
  State& state = *state_;
  if (H5Fflush(state.file.get(), H5F_SCOPE_LOCAL) < 0) state.fail();
  state.columns.clear();
  state.group = {};
  state.file = {};
  state.part.commit();
}

void writeHdf5(const std::filesystem::path& path, std::span<const NamedColumn> columns,
               const FileAttributes& attributes) {
  Hdf5Writer writer(path, attributes);
  writer.beginTable("/", "measured table: one row per motor sample", columns);
  writer.append(columns);
  writer.commit();
}

}  // namespace capstan::table_files
