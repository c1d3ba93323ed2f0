// h5py, SciPy and Octave are the oracles: they read our files, and we read theirs.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/core/table_files/sample_table.h"

namespace capstan::table_files {
namespace {

using ::testing::ElementsAre;

constexpr const char* kSameNumbers =
    "def check(f):\n"
    "  assert list(f('t')) == [0.0, 0.1, 1 / 3, 1e15 + 0.125, 2e16], f('t')\n"
    "  q = f('q_m1')\n"
    "  assert str(q[0]) == '-0.0' and q[1] == 5e-324 and q[2] == np.finfo(float).max and q[4] == 2.0 ** -52, "
    "q\n"
    "  p = f('p_c1')\n"
    "  assert np.isnan(p[0]) and p[1] == 0.07 and p[4] == -1e-300, p\n";

TEST_F(TableFiles, PythonReadsOurNumbers) {
  if (!hasPython()) GTEST_SKIP() << "needs python3-h5py and python3-scipy";
  writeAll("a.h5", hardNumbers());
  writeAll("a5.mat", hardNumbers(), MatlabVersion::k5);
  writeAll("a73.mat", hardNumbers(), MatlabVersion::k73);
  EXPECT_TRUE(python(std::string(kSameNumbers) +
                     "f = h5py.File('a.h5'); check(lambda n: f[n][:])\n"
                     "assert f['t'].dtype == '<f8' and f['t'].attrs['unit'] == 'rad'\n"
                     "assert f.attrs['robot'] == 'a robot'\n"
                     "m = sio.loadmat('a5.mat'); check(lambda n: m[n][:, 0])\n"
                     "g = h5py.File('a73.mat'); check(lambda n: g[n][0, :])\n"
                     "assert g['t'].attrs['MATLAB_class'] == b'double'\n"));
}

TEST_F(TableFiles, WeReadFilesOfPython) {
  if (!hasPython()) GTEST_SKIP() << "needs python3-h5py and python3-scipy";
  ASSERT_TRUE(python(
      "t = np.array([1, 2, 3])\n"
      "with h5py.File('a.h5', 'w') as f:\n"
      "  f['t'] = t; f['q1'] = np.float32([0.5, np.nan, 1.5]); f['q2'] = t.reshape(3, 1) / 4\n"
      "  f['q3'] = t.astype('>f8').reshape(1, 3); f.attrs['x'] = 'y'\n"
      "with h5py.File('group.h5', 'w') as f:\n"
      "  f['trial/t'] = t; f['other/x'] = t; f.create_dataset('trial/q1', data=t, compression='gzip')\n"
      "sio.savemat('a.mat', {'t': t, 'q1': np.int8([-1, 0, 1]), 'note': 'text', 'm': np.eye(3)})\n"
      "sio.savemat('s.mat', {'trial': {'t': t.astype(float), 'q1': np.float32([0, 1, 2])}},\n"
      "            do_compression=True)\n"));
  Columns h5 = readAll(path("a.h5"));
  EXPECT_THAT(h5["t"], ElementsAre(1, 2, 3));
  EXPECT_TRUE(std::isnan(h5["q1"][1]));
  EXPECT_THAT(h5["q2"], ElementsAre(0.25, 0.5, 0.75));
  EXPECT_THAT(h5["q3"], ElementsAre(1, 2, 3));
  EXPECT_THAT(readAll(path("group.h5"))["t"], ElementsAre(1, 2, 3));
  Columns mat;  // a measured table ignores what is no column of it
  columnsIn(path("a.mat")).read([&](std::string_view name, std::size_t) -> std::vector<double>* {
    return name == "note" || name == "m" ? nullptr : &mat[std::string(name)];
  });
  EXPECT_THAT(mat["t"], ElementsAre(1, 2, 3));
  EXPECT_THAT(mat["q1"], ElementsAre(-1, 0, 1));
  EXPECT_THAT(readAll(path("s.mat"))["t"], ElementsAre(1, 2, 3));
  EXPECT_THAT(readAll(path("s.mat"))["q1"], ElementsAre(0, 1, 2));
}

TEST_F(TableFiles, OctaveReadsOurNumbersAndWeReadItsFiles) {
  if (std::system("octave --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "needs octave";
  writeAll("a.mat", hardNumbers());
  write(
      "run.m",
      "a = load('a.mat');\n"
      "assert(isequal(a.t, [0; 0.1; 1 / 3; 1e15 + 0.125; 2e16]));\n"
      "assert(1 / a.q_m1(1) == -Inf && a.q_m1(3) == realmax && isnan(a.p_c1(1)) && a.p_c1(5) == -1e-300);\n"
      "t = (1:3)'; q1 = single([0.5 NaN 1.5]); trial = struct('t', 1:3, 'q1', [7 8 9]);\n"
      "save('-v6', 'v6.mat', 't', 'q1'); save('-v7', 'v7.mat', 't', 'q1'); save('-v7', 's.mat', 'trial');\n");
  ASSERT_EQ(std::system(("cd " + folder_.string() + " && octave --no-gui -q run.m 2>octave.txt").c_str()), 0)
      << bytesOf("octave.txt");
  for (const char* name : {"v6.mat", "v7.mat"}) {
    Columns columns = readAll(path(name));
    EXPECT_THAT(columns["t"], ElementsAre(1, 2, 3));
    EXPECT_EQ(columns["q1"][2], 1.5);
    EXPECT_TRUE(std::isnan(columns["q1"][1]));
  }
  EXPECT_THAT(readAll(path("s.mat"))["q1"], ElementsAre(7, 8, 9));
}

}  // namespace
}  // namespace capstan::table_files
