// Nothing of the robot allocates once built. Every allocation of the process goes through the malloc defined
// here.
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>

#include "core/robot/arm_dynamics.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/chain_dynamics.h"
#include "core/robot/transmission.h"
#include "tests/core/robot/robot_files.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CAPSTAN_COUNTS_ALLOCATIONS 0
#else
#define CAPSTAN_COUNTS_ALLOCATIONS 1
#endif

namespace {
std::atomic<long> allocations{0};
}

#if CAPSTAN_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT: glibc's own name
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT: glibc's own name
void* malloc(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_memalign(alignment, size);
}
}
#endif

namespace capstan::robot {
namespace {

using Eigen::Vector3d;

TEST(Allocation, counterCounts) {
  if (!CAPSTAN_COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer owns malloc";
  const long before = allocations;
  const Eigen::VectorXd heap = Eigen::VectorXd::Zero(100 + static_cast<Eigen::Index>(before % 2));
  EXPECT_EQ(heap.sum(), 0.0);
  EXPECT_GT(allocations, before);
}

TEST(Allocation, noneAfterConstruction) {
  if (!CAPSTAN_COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer owns malloc";
  const Description robot = testing::raven();
  base::Random random(1);
  const Description long_robot = testing::randomRobot(random, kMaxJoints);
  const Chain chain(long_robot);
  const ChainDynamics dynamics(long_robot);
  const ArmKinematics arm(robot);
  const ArmDynamics arm_dynamics(robot);
  const Transmission transmission(robot);
  const JointVector seven = 0.3 * JointVector::Ones(kMaxJoints);

  const long before = allocations;
  double sum = 0.0;
  for (int k = 0; k < 100; ++k) {
    const Vector3d q(0.3, 1.5, 0.3 + 0.001 * k), dq(0.1, 0.2, 0.3);
    const Vector3d tau = arm_dynamics.inverse(q, dq, dq);
    sum += arm_dynamics.forward(q, dq, tau).sum() + arm_dynamics.massMatrix(q).sum();
    sum += arm.solvePosition(arm.tip(q), q).value().sum() + arm.tipJacobian(q).sum();
    Vector6d pose;
    pose << q, dq;
    sum += arm.solvePose(arm.toolPose(pose), pose).value().sum();
    sum += transmission.jointFromMotor(transmission.motorFromJoint(q)).sum() +
           transmission.jointTorque(dq).sum() +
           transmission.jointVelocityFromMotor(transmission.motorVelocityFromJoint(dq)).sum();
    sum += dynamics.forward(seven, seven, dynamics.inverse(seven, seven, seven)).sum();
    sum += dynamics.massMatrix(seven).sum() + dynamics.kineticEnergy(seven, seven) +
           dynamics.potentialEnergy(seven);
    sum += chain.marker(seven).sum() + chain.markerJacobian(seven).sum();
  }
  EXPECT_EQ(allocations - before, 0);
  EXPECT_TRUE(std::isfinite(sum));
}

}  // namespace
}  // namespace capstan::robot
