/// Runs the real capstan-cli in a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/folders.h"

namespace capstan::testing {

namespace fs = std::filesystem;
using nlohmann::json;

struct Ran {
  int exit = -1;
  std::string out, err;
};

class Cli : public ::testing::Test {
 protected:
  Cli() : folder_(fs::temp_directory_path() / ("capstan_cli_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Cli() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// In a shell, behind the shell command `before`.
  Ran run(const std::string& arguments, const std::string& before = {}) const {
    return runShell(before + test::commandLineProgram() + " " + arguments);
  }
  Ran runShell(const std::string& command) const {
    FILE* pipe = popen(("(" + command + "\n) 2>" + path("stderr.txt")).c_str(), "r");
    Ran result;
    char buffer[4096];
    while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe)) result.out.append(buffer, got);
    const int status = pclose(pipe);
    result.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    result.err = textOf("stderr.txt");
    return result;
  }
  /// Starts a command, sends it `signal` (Ctrl-C) once `file` is there, and waits for the end.
  Ran interrupt(const std::string& arguments, const std::string& file, int signal = SIGINT) const {
    const std::string command =
        "exec " + test::commandLineProgram() + " " + arguments + " >/dev/null 2>" + path("stderr.txt");
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    int status = 0;
    while (!fs::exists(file) && waitpid(child, &status, WNOHANG) == 0) usleep(1000);
    kill(child, signal);
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, {}, textOf("stderr.txt")};
  }
  std::string textOf(const std::string& name) const {
    std::stringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
  }
  std::string simulate(const std::string& name, const std::string& more) const {
    const Ran made = run("simulate --out " + path(name) + " --seed 9 " + more);
    EXPECT_EQ(made.exit, 0) << made.err;
    return path(name);
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }

  /// Options of `simulate`: a motion of all joints, quick to make.
  static constexpr const char* kMotion = "--trajectory sinusoid --no-images ";

  fs::path folder_;
};

}  // namespace capstan::testing
