#include <gmock/gmock.h>

#include <random>

#include "tests/core/table_files/sample_table.h"

namespace capstan::table_files {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(TableFiles, BinaryErrorsNameColumnAndValue) {
  if (!hasPython()) GTEST_SKIP() << "needs python3-h5py and python3-scipy";
  ASSERT_TRUE(python(R"(t = np.arange(3.0)
def h5(name, **data):
  with h5py.File(name + '.h5', 'w') as f:
    f['t'] = t
    for key, value in data.items(): f[key] = value
h5('rank', q1=np.eye(3)); h5('scalar', q1=1.0); h5('text', q1=['a', 'b', 'c']); h5('length', q1=np.arange(4.0))
h5('infinite', q1=[0, np.inf, 1]); h5('cube', q1=np.zeros((3, 1, 1))); h5('complex', q1=t * 1j)
with h5py.File('lzf.h5', 'w') as f: f.create_dataset('t', data=t, compression='lzf')
with h5py.File('none.h5', 'w') as f: f['t'] = np.zeros(0)
with h5py.File('huge.h5', 'w') as f: f.create_dataset('t', shape=(1 << 40,), dtype='f8', chunks=(1024,))
with h5py.File('large.h5', 'w') as f: f.create_dataset('t', shape=(1 << 30,), dtype='f8', chunks=(1024,))
with h5py.File('chunk.h5', 'w') as f: f.create_dataset('t', shape=(1 << 28,), dtype='f8', chunks=(1 << 28,))
with h5py.File('outside.h5', 'w') as f:
  f.create_dataset('t', shape=(3,), dtype='f8', external=[('secret.bin', 0, 24)])
with h5py.File('virtual.h5', 'w') as f:
  layout = h5py.VirtualLayout(shape=(3,), dtype='f8'); layout[:] = h5py.VirtualSource('rank.h5', 't', shape=(3,))
  f.create_virtual_dataset('t', layout)
with h5py.File('link.h5', 'w') as f: f['t'] = h5py.ExternalLink('rank.h5', '/t')
def mat(name, **data): sio.savemat(name + '.mat', dict(t=t, **data))
mat('square', q1=np.eye(3)); mat('complex', q1=t * 1j); mat('length', q1=np.arange(4.0)); mat('text', q1='abc')
mat('infinite', q1=[0, -np.inf, 1]); sio.savemat('none.mat', dict(t=np.zeros((0, 0))))
)"));
  write("empty.h5", ""), write("text.mat.h5", "t\n1\n"), write("csv.mat", "t\n1\n");
  const std::map<std::string, std::string> errors = {
      {"rank.h5", "q1 = 3 × 3: is no column"},
      {"cube.h5", "q1 = 3 dimensions: is no column"},
      {"scalar.h5", "q1 = 0 dimensions: is no column"},
      {"text.h5", "q1: does not hold numbers"},
      {"complex.h5", "q1: does not hold numbers"},
      {"length.h5", "t = 3 rows: does not have the 4 rows of q1"},
      {"infinite.h5", "q1, row 2 = inf: is not a finite number"},
      {"lzf.h5", "t = filter 32000: is compressed in a way that HDF5 itself does not know"},
      {"none.h5", "t: has no rows"},
      {"huge.h5", "t = 1099511627776: has more than 2147483648 rows"},
      {"large.h5", "t = 1073741824 rows: has more rows than its 0 bytes can hold"},
      {"chunk.h5", "t: has chunks of more than 64 MiB"},
      {"outside.h5", "t: is stored in another file"},
      {"virtual.h5", "t: is stored in another file"},
      {"link.h5", ""},  // not followed: it has no columns
      {"empty.h5", "cannot be read as an HDF5 file"},
      {"text.mat.h5", "cannot be read as an HDF5 file"},
      {"csv.mat", "is no MATLAB file of version 5 or 7.3"},
      {"square.mat", "q1 = 3 × 3: is no column"},
      {"complex.mat", "q1: does not hold real numbers"},
      {"text.mat", "q1: does not hold real numbers"},
      {"length.mat", "q1 = 4 rows: does not have the 3 rows of t"},
      {"infinite.mat", "q1, row 2 = -inf: is not a finite number"},
      {"none.mat", "t: has no rows"},
      {"nowhere.mat", "cannot be opened"},
  };
  for (const auto& [name, error] : errors) {
    const std::string found = errorOf(path(name));
    if (error.empty()) {
      EXPECT_EQ(found, "");
      EXPECT_TRUE(readAll(path(name)).empty());
    } else {
      EXPECT_THAT(found, StartsWith(path(name))) << name;
      EXPECT_THAT(found, HasSubstr(error)) << name;
    }
  }
}

/// Changes, removes and inserts a few bytes, most of them near the beginning.
std::string damaged(std::string bytes, std::mt19937& random) {
  const auto at = [&](std::size_t below) { return random() % std::min(below, bytes.size()); };
  for (std::size_t changes = 1 + random() % 4; changes > 0 && !bytes.empty(); --changes) {
    const char byte = static_cast<char>(random());
    switch (random() % 4) {
      case 0:
        bytes[at(bytes.size())] = byte;
        break;
      case 1:
        bytes[at(4096)] ^= static_cast<char>(1U << (random() % 8));
        break;
      case 2:
        bytes.insert(at(bytes.size()), 1, byte);
        break;
      default:
        bytes.resize(at(bytes.size()));
    }
  }
  return bytes;
}

TEST_F(TableFiles, DamagedFilesAreReadOrRefused) {
  writeAll("a.jsonl", hardNumbers());
  writeAll("a.h5", hardNumbers());
  writeAll("a.mat", hardNumbers());
  writeAll("a73.mat", hardNumbers(), MatlabVersion::k73);
  std::mt19937 random(7);
  for (const char* name : {"a.jsonl", "a.h5", "a.mat", "a73.mat"}) {
    const std::string bytes = bytesOf(name);
    const std::string copy = "damaged_" + std::string(name);
    int refused = 0;
    for (int i = 0; i < 250; ++i) {
      write(copy, damaged(bytes, random));
      refused += errorOf(path(copy)).empty() ? 0 : 1;  // any other exception, or a crash, fails the test
    }
    EXPECT_GT(refused, 25) << name;
  }
}

}  // namespace
}  // namespace capstan::table_files
