// Files of other programs: every command that reads a measured table reads every kind of file.
#include <gmock/gmock.h>

#include "tests/app/cli_fixture.h"

namespace capstan::testing {
namespace {

using ::testing::HasSubstr;

class CliTables : public Cli {
 protected:
  /// A session of some seconds, and its table in every kind.
  void SetUp() override {
    simulate("s.capstan", "--no-images --duration 4 --trajectory sinusoid --truth matched");
    for (const char* kind : {"csv", "jsonl", "h5", "mat"}) convert("s.capstan", std::string("t.") + kind);
    convert("s.capstan", "t73.mat", "--matlab 7.3");
  }
  void convert(const std::string& in, const std::string& out, const std::string& more = {}) const {
    const Ran ran = run("convert " + path(in) + " " + path(out) + " " + more);
    ASSERT_EQ(ran.exit, 0) << ran.err;
  }
};

TEST_F(CliTables, TheTableIsTheSameBehindEveryKind) {
  for (const char* name : {"t.jsonl", "t.h5", "t.mat", "t73.mat"}) {
    convert(name, std::string(name) + ".csv");
    EXPECT_EQ(textOf(std::string(name) + ".csv"), textOf("t.csv")) << name;
  }
  convert("t.h5", "again.capstan");
  convert("again.capstan", "again.csv");
  EXPECT_EQ(textOf("again.csv"), textOf("t.csv"));
}

TEST_F(CliTables, EveryKindIsTrackedAlike) {
  ASSERT_EQ(run("track " + path("t.csv") + " --out " + path("csv.csv")).exit, 0);
  for (const char* kind : {"jsonl", "h5", "mat"}) {
    const Ran ran = run("track " + path(std::string("t.") + kind) + " --out " + path("other.csv"));
    ASSERT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(textOf("other.csv"), textOf("csv.csv")) << kind;
    EXPECT_EQ(run("info " + path(std::string("t.") + kind)).exit, 0);
  }
}

TEST_F(CliTables, HelpAndErrorsListTheKinds) {
  const char* kinds = ".csv, .jsonl, .h5, .hdf5, .mat";
  for (const char* command : {"track", "convert", "diagnose", "identify", "info", "report", "play"})
    EXPECT_THAT(run(std::string(command) + " --help").out, HasSubstr(kinds)) << command;
  const Ran wrong = run("convert " + path("t.csv") + " " + path("t.xls"));
  EXPECT_EQ(wrong.exit, 2);
  EXPECT_THAT(wrong.err, HasSubstr(kinds));
}

TEST_F(CliTables, AnHdf5FileOfASessionHasTheRowsOfEverySensor) {
  if (runShell("/usr/bin/python3 -c 'import h5py'").exit != 0) GTEST_SKIP() << "needs python3-h5py";
  write("check.py",
        "import h5py, csv\n"
        "f = h5py.File('t.h5')\n"
        "for name in ('motor', 'joint', 'tip'):\n"
        "  rows = list(csv.DictReader(open('tables/' + name + '.csv')))\n"
        "  assert len(rows) > 50\n"
        "  for key in rows[0]:\n"
        "    for a, b in zip(f[name][key][:], rows): assert (b[key] == '' and a != a) or float(b[key]) == a\n"
        "print(f.attrs['robot'], f['q3'].attrs['unit'], f.attrs['format_version'])\n");
  convert("s.capstan", "tables", "--to csv-folder");
  const Ran ran = runShell("cd " + path("") + "; /usr/bin/python3 check.py");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.out, "RAVEN-II left m 1\n");
}

}  // namespace
}  // namespace capstan::testing
