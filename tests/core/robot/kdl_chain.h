#pragma once

#include <kdl/chain.hpp>
#include <kdl/jntarray.hpp>

#include "core/robot/description.h"
#include "core/robot/joint_vector.h"

/// The same robot for Orocos KDL: one segment a joint, the joint's axis placed in the frame before it.
namespace capstan::robot::testing {

inline KDL::Vector kdlVector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

inline KDL::Chain kdlChain(const Description& robot) {
  KDL::Chain chain;
  for (const Joint& joint : robot.joints) {
    const KDL::Frame frame = KDL::Frame::DH_Craig1989(joint.dh.a, joint.dh.alpha, joint.dh.d, joint.dh.theta);
    const auto kind = joint.type == JointType::kRevolute ? KDL::Joint::RotAxis : KDL::Joint::TransAxis;
    const KDL::RotationalInertia inertia(joint.link.inertia.x(), joint.link.inertia.y(),
                                         joint.link.inertia.z());
    chain.addSegment(
        KDL::Segment(KDL::Joint("", frame.p, frame.M.UnitZ(), kind), frame,
                     KDL::RigidBodyInertia(joint.link.mass, kdlVector(joint.link.centre_of_mass), inertia)));
  }
  return chain;
}

inline KDL::JntArray kdlArray(const JointVector& v) {
  KDL::JntArray array(static_cast<unsigned>(v.size()));
  array.data = v;
  return array;
}

}  // namespace capstan::robot::testing
