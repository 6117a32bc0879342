// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/skid_steer.h"

#include <fmt/format.h>

#include <cmath>
#include <gazebo/physics/physics.hh>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"

namespace tagfield {

void run_motor(gazebo::physics::Joint& joint, double speed, double effort) {
  joint.SetParam("fmax", 0, effort);
  joint.SetParam("vel", 0, speed);
}

void expect_ode(gazebo::physics::World& world) {
  const std::string type = world.Physics()->GetType();
  if (type != "ode") throw Error(fmt::format("physics is '{}', expected ode", type));
}

WheelSide::WheelSide(gazebo::physics::Model& model, const char* key,
                     const std::vector<std::string>& joints, double torque_nm)
    : torque_nm_(torque_nm) {
  for (const std::string& name : joints) {
    const gazebo::physics::JointPtr joint = model.GetJoint(name);
    if (!joint) throw Error(fmt::format("<{}> is '{}', which the model does not have", key, name));
    if (!joint->HasType(gazebo::physics::Base::HINGE_JOINT)) {
      throw Error(fmt::format("<{}> is '{}', expected a revolute joint", key, name));
    }
    wheels_.push_back({joint, joint->Position(0)});
  }
}

void WheelSide::turn(double speed) {
  for (const Wheel& wheel : wheels_) run_motor(*wheel.joint, speed, torque_nm_);
}

double WheelSide::angle() {
  double sum = 0.0;
  for (Wheel& wheel : wheels_) {
    wheel.angle += wrap_to_pi(wheel.joint->Position(0) - wheel.angle);
    sum += wheel.angle;
  }
  return sum / static_cast<double>(wheels_.size());
}

void SkidSteer::drive(const BodyVelocity& velocity) {
  const WheelSpeeds speeds = wheel_speeds(drive_, velocity);
  left_.turn(speeds.left);
  right_.turn(speeds.right);
}

}  // namespace tagfield
