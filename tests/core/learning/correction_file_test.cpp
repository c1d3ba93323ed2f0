// Models of corrections, written and read back; files that are none.
#include "core/learning/model/correction_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/yaml.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::learning {
namespace {

std::vector<learning::State> states(std::size_t n) {
  base::Random random(5, "states");
  std::vector<learning::State> made(n);
  for (learning::State& state : made) {
    for (int i = 0; i < 3; ++i) state.pair.observed.translation()[i] = random.uniform(-0.05, 0.05);
    for (int i = 0; i < 6; ++i) state.velocity[i] = random.uniform(-0.1, 0.1);
    state.pair.commanded = state.pair.observed;
    state.pair.commanded.translation().x() +=
        0.01 + 2e-3 * std::sin(60.0 * state.pair.observed.translation().y());
  }
  return made;
}

CorrectionFile learned() {
  learning::CorrectionOptions options;
  options.likelihood_points = 100;
  options.inducing_points = 80;
  return {
      learning::CorrectionModel::trained(states(200), options),
      {{"left.csv"}, {"0123456789abcdef"}, learning::StreamKind::kRobot, 0.0056, 200, 12, "capstan test"}};
}

/// What reading `path` complains of.
std::string complaintOf(const std::filesystem::path& path) {
  try {
    readCorrection(path);
    return "nothing";
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    return error.what();
  }
}

TEST(CorrectionFile, isReadAsItWasWritten) {
  const recording::testing::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "arm.correction";
  const CorrectionFile file = learned();
  writeCorrection(file, path);
  const CorrectionFile read = readCorrection(path);
  EXPECT_EQ(read.source, file.source);
  for (const learning::State& state : states(20)) {
    const learning::Corrected was = file.model.correct(state), is = read.model.correct(state);
    EXPECT_EQ(was.pose.matrix(), is.pose.matrix());
    EXPECT_EQ(was.sigma, is.sigma);
    EXPECT_EQ(was.confidence, is.confidence);
  }
}

TEST(CorrectionFile, learnsOnAfterReading) {
  const recording::testing::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "arm.correction";
  CorrectionFile file = learned();
  writeCorrection(file, path);
  CorrectionFile read = readCorrection(path);
  file.model.add(states(40));
  read.model.add(states(40));
  const learning::State at = states(1).front();
  EXPECT_EQ(read.model.correct(at).pose.matrix(), file.model.correct(at).pose.matrix());
}

TEST(CorrectionFile, refusesWhatIsDamaged) {
  const recording::testing::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "arm.correction";
  writeCorrection(learned(), path);
  const std::string whole = base::readTextFile(path);
  const auto complaint = [&](const std::string& text) {
    base::writeTextFile(path, text);
    return complaintOf(path);
  };
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 1;
  EXPECT_NE(complaint(flipped).find("checksum"), std::string::npos);
  std::string renamed = whole;
  renamed.replace(renamed.find("left.csv"), 4, "righ");
  EXPECT_NE(complaint(renamed).find("checksum"), std::string::npos);
  EXPECT_NE(complaint(whole.substr(0, whole.size() - 800)).find("numbers"), std::string::npos);
  EXPECT_NE(complaint(whole.substr(0, 60)).find("second line"), std::string::npos);
  EXPECT_NE(complaint("t,q1\n0,1\n").find("is no model"), std::string::npos);
  std::string later = whole;
  later.replace(later.find(" 3\n"), 3, " 9\n");
  EXPECT_NE(complaint(later).find("version 9"), std::string::npos);
  EXPECT_NE(complaintOf(folder.path() / "none").find("none"), std::string::npos);
}

TEST(CorrectionFile, keepsWhatStoodThereWhenItCannotBeWritten) {
  const recording::testing::TemporaryFolder folder;
  EXPECT_THROW(writeCorrection(learned(), folder.path() / "no" / "arm.correction"), base::InputError);
}

}  // namespace
}  // namespace capstan::learning
