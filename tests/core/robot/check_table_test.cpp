// The table of 200 random states from an independent implementation of the RAVEN-II model.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "core/robot/arm_dynamics.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/chain/chain_bodies.h"
#include "core/robot/chain/chain_model.h"
#include "core/robot/chain_dynamics.h"
#include "tests/core/robot/robot_files.h"
#include "tests/support/folders.h"

namespace capstan::robot {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using capstan::test::sharedFile;

class Table {
 public:
  explicit Table(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::string line, cell;
    std::getline(in, line);
    std::istringstream header(line);
    while (std::getline(header, cell, ',')) names_.push_back(cell);
    while (std::getline(in, line)) {
      std::istringstream row(line);
      for (const std::string& name : names_) {
        std::getline(row, cell, ',');
        columns_[name].push_back(std::stod(cell));
      }
    }
  }
  std::size_t rows() const { return columns_.at("q1").size(); }
  double at(const std::string& column, std::size_t row) const { return columns_.at(column)[row]; }
  Vector3d vector(const std::string& name, std::size_t row) const {
    return {at(name + "1", row), at(name + "2", row), at(name + "3", row)};
  }
  double rootMeanSquare(const std::string& column) const {
    double sum = 0.0;
    for (const double value : columns_.at(column)) sum += value * value;
    return std::sqrt(sum / static_cast<double>(rows()));
  }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<double>> columns_;
};

/// Largest |ours − theirs|, relative to the entry or its column's root mean square, whichever is larger: the
/// table's inputs have twelve digits, and where terms cancel fewer are left. A column of nothing but rounding
/// (1e-18): to 1.
class Worst {
 public:
  explicit Worst(const Table& table) : table_(table) {}
  void see(const std::string& column, std::size_t row, double ours) {
    const double scale = table_.rootMeanSquare(column);
    const double theirs = table_.at(column, row);
    const double unit = scale < 1e-12 ? 1.0 : std::max(std::abs(theirs), scale);
    largest_ = std::max(largest_, std::abs(ours - theirs) / unit);
  }
  double largest() const { return largest_; }

 private:
  const Table& table_;
  double largest_ = 0.0;
};

struct Differences {
  double torque, mass, tip;
};

template <class Inverse, class Mass, class Tip>
Differences compare(const Table& table, Inverse inverse, Mass mass, Tip tip) {
  Worst torque(table), matrix(table), point(table);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Vector3d q = table.vector("q", row);
    const Vector3d tau = inverse(q, table.vector("dq", row), table.vector("ddq", row));
    const Matrix3d m = mass(q);
    const Vector3d p = tip(q);
    for (int i = 0; i < 3; ++i) {
      torque.see(fmt::format("tau{}", i + 1), row, tau[i]);
      point.see(fmt::format("tip_{}", "xyz"[i]), row, p[i]);
      for (int j = i; j < 3; ++j) matrix.see(fmt::format("M{}{}", i + 1, j + 1), row, m(i, j));
    }
  }
  return {torque.largest(), matrix.largest(), point.largest()};
}

void expectSmall(const char* who, const Differences& d) {
  fmt::print("{}: largest relative difference of torque {:.2e}, mass matrix {:.2e}, tip {:.2e}\n", who,
             d.torque, d.mass, d.tip);
  EXPECT_LE(d.torque, 1e-9);
  EXPECT_LE(d.mass, 1e-9);
  EXPECT_LE(d.tip, 1e-9);
}

TEST(CheckTable, bothDynamicsAndBothKinematicsAgreeWithTheIndependentImplementation) {
  const auto path = sharedFile("raven2-check.csv");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no table of check values at " << path;
  const Table table(path);
  ASSERT_EQ(table.rows(), 200U);
  const Description robot = testing::raven();

  const ArmDynamics arm(robot);
  const ArmKinematics kinematics(robot);
  expectSmall("closed form", compare(
                                 table,
                                 [&](const Vector3d& q, const Vector3d& dq, const Vector3d& ddq) {
                                   return arm.inverse(q, dq, ddq);
                                 },
                                 [&](const Vector3d& q) { return arm.massMatrix(q); },
                                 [&](const Vector3d& q) { return kinematics.tip(q); }));

  const ChainDynamics chain(robot);
  const Chain links(robot);
  expectSmall("recursive", compare(
                               table,
                               [&](const Vector3d& q, const Vector3d& dq, const Vector3d& ddq) -> Vector3d {
                                 return chain.inverse(q, dq, ddq);
                               },
                               [&](const Vector3d& q) -> Matrix3d { return chain.massMatrix(q); },
                               [&](const Vector3d& q) { return links.marker(q); }));

  const ChainModel model(robot);
  const auto bodies = [&](const Vector3d& q, const Vector3d& dq) {
    ChainBodies<double> now;
    chainBodies<double>(model.shape, model.numbers, q.data(), dq.data(), now);
    return now;
  };
  const auto massOfKernel = [&](const Vector3d& q) -> Matrix3d {
    const ChainBodies<double> now = bodies(q, Vector3d::Zero());
    Matrix3d mass;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) mass(i, j) = now.mass[i][j];
    return mass;
  };
  expectSmall("kernels'", compare(
                              table,
                              [&](const Vector3d& q, const Vector3d& dq, const Vector3d& ddq) -> Vector3d {
                                const ChainBodies<double> now = bodies(q, dq);
                                return massOfKernel(q) * ddq + Vector3d(now.bias);
                              },
                              massOfKernel, [&](const Vector3d& q) { return links.marker(q); }));
}

}  // namespace
}  // namespace capstan::robot
