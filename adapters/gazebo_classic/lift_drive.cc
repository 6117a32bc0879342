// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/lift_drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <gazebo/physics/physics.hh>

#include "adapters/gazebo_classic/skid_steer.h"
#include "tagfield/base/error.h"

namespace tagfield {
namespace {

/// Maximum speed for catching up, if something blocked the joint or it started elsewhere [m/s].
constexpr double kMaxSpeed = 2.0;

}  // namespace

LiftDrive::LiftDrive(gazebo::physics::Model& model, const std::string& joint, double force_n)
    : joint_(model.GetJoint(joint)), force_n_(force_n) {
  if (!joint_) throw Error(fmt::format("<joint> is '{}', which the model does not have", joint));
  if (!joint_->HasType(gazebo::physics::Base::SLIDER_JOINT)) {
    throw Error(fmt::format("<joint> is '{}', expected a prismatic joint", joint));
  }
}

void LiftDrive::go(double position, double seconds) {
  const double speed = (position - joint_->Position(0)) / seconds;
  run_motor(*joint_, std::clamp(speed, -kMaxSpeed, kMaxSpeed), force_n_);
}

double LiftDrive::position() const { return joint_->Position(0); }

double LiftDrive::speed() const { return joint_->GetVelocity(0); }

}  // namespace tagfield
