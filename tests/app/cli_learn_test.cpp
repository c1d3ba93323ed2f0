// learn and correct, as users run them.
#include <gmock/gmock.h>

#include "tests/app/cli_fixture.h"
#include "tests/support/sample_poses.h"

namespace capstan::testing {
namespace {

using ::testing::HasSubstr;

/// One process, its inputs given, and no weights: the default compares two, averages three and weighs states.
const std::string kQuick = "--method velocity --members 1 --no-weights ";

/// A search of hyperparameters takes the cube of the number of states.
SamplePoses fewPoses() {
  SamplePoses few;
  few.trajectories = 12;
  few.rows = 50;
  return few;
}

class CliLearn : public Cli {
 protected:
  CliLearn() {
    writeSamplePoses(path("train.csv"), fewPoses());
    SamplePoses other = fewPoses();
    other.seed = 2;
    writeSamplePoses(path("test.csv"), other);
  }
  Ran learn(const std::string& more) const {
    return run("learn --train " + path("train.csv") + " --inducing 100 --threads 1 --model " +
               path("m.correction") + " " + more);
  }
};

TEST_F(CliLearn, LearnsTellsAndCorrects) {
  const Ran learned = learn("--test " + path("test.csv") + " --json " + path("m.json"));
  ASSERT_EQ(learned.exit, 0) << learned.err;
  EXPECT_THAT(learned.out, HasSubstr("placeholder"));
  EXPECT_THAT(learned.out, HasSubstr("corrected"));
  const json said = json::parse(textOf("m.json"));
  EXPECT_NEAR(said["clock_offset"]["value"].get<double>(), 0.04, 0.01);
  EXPECT_TRUE(said["weights"]["weighed"].get<bool>());
  EXPECT_TRUE(said["weights"]["readmitted"].is_object()) << "reasons and how many of each";
  EXPECT_EQ(said["model"]["processes"][0]["kernel"], "matern");
  EXPECT_EQ(said["model"]["processes"][0]["members"].size(), 3U);
  const json& clean = said["test"]["clean"];
  const auto meanOf = [&](const char* what) { return clean[what]["distance"]["mean"].get<double>(); };
  EXPECT_LT(meanOf("corrected"), 0.5 * meanOf("offset"));
  EXPECT_LT(meanOf("offset"), 0.5 * meanOf("none"));

  write("wanted.csv", "t_s,x,y,z,qx,qy,qz,qw\n0,0.01,0.0,-0.15,0,0,0,1\n0.1,0.012,0.0,-0.15,0,0,0,1\n");
  const Ran corrected =
      run("correct --model " + path("m.correction") + " " + path("wanted.csv") + " " + path("out.csv"));
  ASSERT_EQ(corrected.exit, 0) << corrected.err;
  EXPECT_THAT(textOf("out.csv"), HasSubstr("traj,t_s,x,y,z,qx,qy,qz,qw,sigma_x"));
  EXPECT_EQ(std::ranges::count(textOf("out.csv"), '\n'), 3);
}

TEST_F(CliLearn, EvaluatesOnTrajectoriesHeldOutAndLearnsFromAll) {
  ASSERT_EQ(learn(kQuick).exit, 0);
  const std::string all = textOf("m.correction");
  const Ran learned = learn(kQuick + "--hold-out 20 --json " + path("m.json"));
  ASSERT_EQ(learned.exit, 0) << learned.err;
  EXPECT_TRUE(textOf("m.correction") == all) << "holding out is for the evaluation alone";
  EXPECT_THAT(learned.out, HasSubstr("2 of 12 trajectories"));
  const json held_out = json::parse(textOf("m.json"))["held_out"];
  EXPECT_LT(held_out["clean"]["corrected"]["distance"]["mean"],
            held_out["clean"]["offset"]["distance"]["mean"]);
  EXPECT_EQ(learn("--hold-out 0").exit, 2);
  EXPECT_EQ(learn("--hold-out 20 --onto " + path("m.correction")).exit, 2);
}

TEST_F(CliLearn, CorrectsPlannedMotionsAlongTheirPathsOrAtTheirEnds) {
  ASSERT_EQ(learn(kQuick).exit, 0);
  std::string text = "traj,t_s,x,y,z,qx,qy,qz,qw\n";
  for (int k = 0; k <= 10; ++k)
    text += "1," + std::to_string(0.1 * k) + "," + std::to_string(0.01 + 0.001 * k) + ",0,0,0,0,0,1\n";
  write("motions.csv", text);
  const std::string correct = "correct --model " + path("m.correction") + " " + path("motions.csv") + " ";
  const Ran whole = run(correct + path("path.csv") + " --path"),
            ends = run(correct + path("ends.csv") + " --end-point");
  ASSERT_EQ(whole.exit, 0) << whole.err;
  ASSERT_EQ(ends.exit, 0) << ends.err;
  EXPECT_THAT(whole.out, HasSubstr("1 motions, 11 waypoints"));
  EXPECT_EQ(textOf("path.csv").rfind("traj,t_s,x,y,z,qx,qy,qz,qw,confidence\n", 0), 0U);
  EXPECT_EQ(std::ranges::count(textOf("ends.csv"), '\n'), 12);
  EXPECT_NE(textOf("path.csv"), textOf("ends.csv"));
  EXPECT_EQ(run(correct + path("both.csv") + " --path --end-point").exit, 2);
  write("motions.csv", "x,y,z,qx,qy,qz,qw\n0.01,0,-0.15,0,0,0,1\n");
  const Ran untimed = run(correct + path("none.csv") + " --path");
  EXPECT_EQ(untimed.exit, 2);
  EXPECT_THAT(untimed.err, HasSubstr("t_s"));
}

TEST_F(CliLearn, LearnsAsThePaperDoes) {
  ASSERT_EQ(learn("--method velocity --no-weights --kernel rbf --members 1 --json " + path("m.json")).exit,
            0);
  const json said = json::parse(textOf("m.json"));
  EXPECT_FALSE(said["weights"]["weighed"].get<bool>());
  for (const json& process : said["model"]["processes"]) {
    EXPECT_EQ(process["kernel"], "rbf");
    EXPECT_EQ(process["members"].size(), 1U);
  }
}

TEST_F(CliLearn, SaysWhereAPathIsWrong) {
  ASSERT_EQ(learn("--method offset").exit, 0);
  const std::string ask =
      "correct --model " + path("m.correction") + " " + path("wanted.csv") + " " + path("out.csv");
  write("wanted.csv", "t_s,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n0,0,0,0,0,0,0,1\n");
  EXPECT_THAT(run(ask).err, HasSubstr("wanted.csv:3: t_s = 0"));
  write("wanted.csv", "x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,2\n");
  EXPECT_THAT(run(ask).err, HasSubstr("wanted.csv:2: qw = 2"));
  write("wanted.csv", "x,y,z\n0,0,0\n");
  EXPECT_THAT(run(ask).err, HasSubstr("qx: is missing"));
  EXPECT_FALSE(fs::exists(path("out.csv")));
  write("wanted.csv", "x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,1\n");
  const Ran at_rest = run(ask);
  EXPECT_EQ(at_rest.exit, 0);
  EXPECT_THAT(at_rest.err, HasSubstr("no t_s"));
}

TEST_F(CliLearn, SaysWhetherAModelHoldsAndLearnsOn) {
  SamplePoses noisy;
  noisy.noise = 1e-4;
  noisy.turn_noise = 3e-4;
  noisy.outliers = noisy.placeholders = 0;
  noisy.trajectories = 40;
  writeSamplePoses(path("train.csv"), noisy);
  noisy.noise_seed = 2;
  writeSamplePoses(path("test.csv"), noisy);
  ASSERT_EQ(learn(kQuick).exit, 0);
  const std::string model = path("m.correction");
  const Ran holds = run("drift --model " + model + " --json " + path("d.json") + " " + path("test.csv"));
  EXPECT_EQ(holds.exit, 0) << holds.out << holds.err;
  EXPECT_THAT(holds.out, HasSubstr("Nothing shows that the model has drifted."));
  const json course = json::parse(textOf("d.json"));
  EXPECT_EQ(course["finding"], "holds");
  EXPECT_EQ(course["beyond"].size(), course["judged"].get<std::size_t>());

  SamplePoses aged = noisy;
  aged.noise_seed = 3;
  aged.bias = 16e-3;
  writeSamplePoses(path("aged.csv"), aged);
  const Ran old = run("drift --model " + model + " " + path("aged.csv"));
  EXPECT_EQ(old.exit, 1) << old.out << old.err;
  EXPECT_THAT(old.out, HasSubstr("The model has drifted: retrain"));
  EXPECT_THAT(
      run("learn --train " + path("aged.csv") + " --onto " + model + " --model " + path("x.correction")).err,
      HasSubstr("contradict what the model has learned"));
  SamplePoses brief = noisy;
  brief.trajectories = 6;
  writeSamplePoses(path("brief.csv"), brief);
  EXPECT_THAT(run("drift --model " + model + " " + path("brief.csv")).out, HasSubstr("Too short to test"));
  EXPECT_EQ(run("drift --span 0.5 --model " + model + " " + path("test.csv")).exit, 2);
  EXPECT_THAT(run("drift --model " + model + " " + path("test.csv") + " " + path("test.csv")).err,
              HasSubstr("is given twice"));

  const Ran more = run("learn --train " + path("test.csv") + " --onto " + model + " --model " +
                       path("more.correction") + " --test " + path("aged.csv"));
  EXPECT_EQ(more.exit, 0) << more.err;
  const Ran commanded = run("learn --train " + path("train.csv") + " --onto " + path("more.correction") +
                            " --model " + path("x.correction"));
  EXPECT_EQ(commanded.exit, 2);
  EXPECT_THAT(commanded.err, HasSubstr("train.csv: is already part of the training"));
  EXPECT_THAT(run("learn --train " + path("test.csv") + " --onto " + model + " --method none --model " +
                  path("x.correction"))
                  .err,
              HasSubstr("--onto"));
}

TEST_F(CliLearn, ProposesWhereToGoNext) {
  ASSERT_EQ(learn(kQuick).exit, 0);
  const std::string ask = "explore --model " + path("m.correction") + " --count 3 " + path("queries.csv");
  const Ran proposed = run(ask);
  ASSERT_EQ(proposed.exit, 0) << proposed.err;
  EXPECT_THAT(proposed.out, HasSubstr("3 of "));
  EXPECT_EQ(std::ranges::count(textOf("queries.csv"), '\n'), 4);
  EXPECT_THAT(proposed.out, HasSubstr("pose   3"));
  write("some.csv", "x,y,z,qx,qy,qz,qw\n0.01,0,-0.15,0,0,0,1\n0.03,0,-0.15,0,0,0,1\n");
  EXPECT_THAT(run(ask + " --among " + path("some.csv")).out, HasSubstr("of 2 query poses"));
  ASSERT_EQ(learn("--method offset").exit, 0);
  EXPECT_THAT(run(ask).err, HasSubstr("is a rigid offset alone"));
  const std::string alone = path("m.correction") + ": is a rigid offset alone";
  EXPECT_THAT(run("learn --train " + path("test.csv") + " --onto " + path("m.correction") + " --model " +
                  path("x.correction"))
                  .err,
              HasSubstr(alone));
  EXPECT_THAT(run("drift --model " + path("m.correction") + " " + path("test.csv")).err, HasSubstr(alone));
  EXPECT_THAT(
      run("correct --model " + path("m.correction") + " " + path("some.csv") + " " + path("o.csv")).err,
      HasSubstr("it has no confidence"));
}

TEST_F(CliLearn, RefusesWhatMakesNoSense) {
  EXPECT_THAT(learn("--test " + path("train.csv")).err, HasSubstr("is also a training table"));
  EXPECT_THAT(learn("--towards sideways").err, HasSubstr("--towards"));
  EXPECT_EQ(run("correct --model " + path("train.csv") + " " + path("test.csv") + " " + path("o.csv")).exit,
            2);
  EXPECT_THAT(run("correct --model " + path("train.csv") + " " + path("test.csv") + " " + path("o.csv")).err,
              HasSubstr("is no model of a correction"));
  EXPECT_FALSE(fs::exists(path("m.correction")));
}

TEST_F(CliLearn, TellsNoSpreadOfOneTrajectory) {
  SamplePoses one;
  one.trajectories = 1;
  one.outliers = 0;
  writeSamplePoses(path("one.csv"), one);
  const Ran learned =
      run("learn --method offset --train " + path("one.csv") + " --model " + path("m.correction"));
  ASSERT_EQ(learned.exit, 0) << learned.err;
  EXPECT_THAT(learned.out, HasSubstr("ms behind commands"));
  EXPECT_THAT(learned.out, ::testing::Not(HasSubstr("±")));
}

/// What is amiss with streams as a whole names the table, too.
TEST_F(CliLearn, NamesTheTableThatItRefuses) {
  SamplePoses robot_alone;
  robot_alone.command = false;
  writeSamplePoses(path("robot.csv"), robot_alone);
  const Ran refused = run("learn --train " + path("robot.csv") + " --model " + path("m.correction"));
  EXPECT_EQ(refused.exit, 2);
  const std::string reason = path("robot.csv") + ": command: these tables have no such poses";
  EXPECT_THAT(refused.err, HasSubstr(reason));
  EXPECT_THAT(learn("--train " + path("robot.csv")).err, HasSubstr(reason)) << "beside a table that has them";
  EXPECT_THAT(learn("--test " + path("robot.csv")).err, HasSubstr(reason));
  EXPECT_FALSE(fs::exists(path("m.correction")));
}

/// A table in millimetres beside a sound one, and poses to correct in millimetres.
TEST_F(CliLearn, RefusesMillimetres) {
  SamplePoses milli;
  milli.unit = 1e-3;
  writeSamplePoses(path("milli.csv"), milli);
  const std::string reason = path("milli.csv") + ": positions of the camera";
  EXPECT_THAT(learn("--method offset --train " + path("milli.csv")).err, HasSubstr(reason));
  EXPECT_THAT(learn("--method offset --test " + path("milli.csv")).err, HasSubstr(reason));
  EXPECT_FALSE(fs::exists(path("m.correction")));
  ASSERT_EQ(learn("--method none --members 1 --no-weights").exit, 0);
  EXPECT_THAT(run("drift --model " + path("m.correction") + " " + path("train.csv")).err,
              HasSubstr("is already part of the training"));
  write("wanted.csv", "x,y,z,qx,qy,qz,qw\n10.0,0,-150,0,0,0,1\n");
  const std::string of = " --model " + path("m.correction") + " ", out = " " + path("out.csv");
  EXPECT_THAT(run("correct" + of + path("wanted.csv") + out).err, HasSubstr("Give positions in metres"));
  EXPECT_THAT(run("explore" + of + "--among " + path("wanted.csv") + out).err,
              HasSubstr("Give positions in metres"));
  EXPECT_FALSE(fs::exists(path("out.csv")));
}

}  // namespace
}  // namespace capstan::testing
