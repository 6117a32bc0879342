// SPDX-License-Identifier: Apache-2.0
// libTagfieldRobotPlugin.so: drives a skid-steered robot by cmd_vel or along waypoints, and
// publishes its odometry, laser and frames. Parameters: tagfield/motion/robot_parameters.h.
#include <fmt/format.h>

#include <atomic>
#include <gazebo/common/Console.hh>
#include <gazebo/common/Events.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/physics/physics.hh>
#include <memory>
#include <optional>

#include "adapters/gazebo_classic/conversions.h"
#include "adapters/gazebo_classic/laser.h"
#include "adapters/gazebo_classic/plugin_elements.h"
#include "adapters/gazebo_classic/plugins/recording.h"
#include "adapters/gazebo_classic/skid_steer.h"
#include "adapters/ros1/robot_publisher.h"
#include "adapters/ros1/ros_link.h"
#include "adapters/ros2/robot_topics.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/motion/robot_parameters.h"

namespace tagfield {
namespace {

constexpr const char* kFile = "libTagfieldRobotPlugin.so";

Eigen::Vector3d eigen(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

RobotNames names_of(const RobotParameters& parameters) {
  return {parameters.name_space,  parameters.base_link,         parameters.odom_frame,
          parameters.laser_frame, parameters.odom_parent_frame, parameters.publish_tf};
}

/// Throws Error unless the link has a `ray` sensor of this name in its SDF.
void expect_ray_sensor(gazebo::physics::Link& link, const std::string& name) {
  const sdf::ElementPtr description = link.GetSDF();
  if (description->HasElement("sensor")) {
    for (sdf::ElementPtr sensor = description->GetElement("sensor"); sensor;
         sensor = sensor->GetNextElement("sensor")) {
      if (sensor->Get<std::string>("name") == name && sensor->Get<std::string>("type") == "ray") {
        return;
      }
    }
  }
  throw Error(fmt::format("<laser> is '{}', expected a sensor of type ray on link '{}'", name,
                          link.GetName()));
}

/// State that is reset with each start of the world.
struct Run {
  RobotDriver driver;
  WheelOdometry odometry;
  RigidTransform X_WO;  ///< The robot's initial pose on the floor.
  Time last;
  Time reported;  ///< Time of the last odometry message.
  BodyVelocity reported_travel;
  bool finished = false;
};

/// One robot in its world.
class Robot {
 public:
  Robot(gazebo::physics::ModelPtr model, RobotParameters parameters, std::string place)
      : model_(std::move(model)),
        world_(model_->GetWorld()),
        parameters_(std::move(parameters)),
        place_(std::move(place)),
        base_(find_base()),
        wheels_(find_wheels()),
        ros_(RosLink::shared()),
        publisher_(ros_, names_of(parameters_)) {
    if (const auto recording = shared_recording(world_)) {
      recorded_.emplace(recording, names_of(parameters_));
    }
    if (!parameters_.laser.empty()) expect_ray_sensor(*base_, parameters_.laser);
  }

  /// To be called at the end of each step of the world.
  void step() {
    const Time now = from_gazebo(world_->SimTime());
    if (restart_.exchange(false) || !run_ || now < run_->last) start(now);
    ros_->advance_clock(now);
    run_->odometry.update(wheels_.angles());
    read_laser(now);
    if (is_due(run_->last, now, odometry_interval_)) report_motion(now);
    drive(now);
    run_->last = now;
  }

  void restart() { restart_ = true; }

 private:
  gazebo::physics::LinkPtr find_base() {
    gazebo::physics::LinkPtr link = model_->GetLink(parameters_.base_link);
    if (!link) {
      throw Error(
          fmt::format("<base_link> is '{}', which the model does not have", parameters_.base_link));
    }
    return link;
  }

  SkidSteer find_wheels() {
    expect_ode(*world_);
    return {WheelSide(*model_, "left_joint", parameters_.left_joints, parameters_.torque_nm),
            WheelSide(*model_, "right_joint", parameters_.right_joints, parameters_.torque_nm),
            parameters_.drive};
  }

  void start(Time now) {
    const RigidTransform X_WB = from_gazebo(base_->WorldPose());
    const PlanarPose pose = planar(X_WB);
    RigidTransform X_WO = to_transform(pose);
    X_WO.translation.z() = X_WB.translation.z();
    run_ = Run{RobotDriver(parameters_.driver),
               WheelOdometry(parameters_.odometry),
               X_WO,
               now,
               now,
               {},
               false};
    if (!parameters_.waypoints.empty()) {
      run_->driver.set_path(PathFollower(pose, parameters_.waypoints, parameters_.style));
      publisher_.publish_path_finished(false);
    }
    publish_fixed_frames(now);
  }

  void publish_fixed_frames(Time now) {
    std::optional<RigidTransform> X_BL;
    if (laser_) X_BL = laser_->X_BL();
    publisher_.publish_fixed_frames(now, X_BL, run_->X_WO);
    if (recorded_) recorded_->publish_fixed_frames(now, X_BL, run_->X_WO);
  }

  template <class Report>
  void tell(const Report& report) {
    publisher_.publish(report);
    if (recorded_) recorded_->publish(report);
  }

  void read_laser(Time now) {
    if (parameters_.laser.empty()) return;
    if (!laser_) {
      // Sensors are created on a separate thread, slightly later than their models.
      const auto sensor = find_ray_sensor(base_->GetScopedName(true), parameters_.laser);
      if (!sensor) return;
      laser_.emplace(sensor);
      publish_fixed_frames(now);
    }
    const std::optional<LaserReading> reading = laser_->read(run_->last, now);
    if (!reading) return;
    tell(ScanReport{reading->stamp, reading->first_angle_rad, reading->last_angle_rad,
                    reading->interval_s, reading->min_range_m, reading->max_range_m,
                    reading->ranges_m});
  }

  void report_motion(Time now) {
    const WheelOdometry& odometry = run_->odometry;
    const double seconds = std::max(to_seconds(now - run_->reported), 1e-9);
    const BodyVelocity velocity{
        (odometry.travel().forward - run_->reported_travel.forward) / seconds,
        (odometry.travel().turn - run_->reported_travel.turn) / seconds};
    tell(OdometryReport{now, odometry.pose(), odometry.covariance(), velocity,
                        velocity_variance(velocity, seconds)});
    run_->reported = now;
    run_->reported_travel = odometry.travel();
    tell(MotionReport{now, from_gazebo(base_->WorldPose()), eigen(base_->RelativeLinearVel()),
                      eigen(base_->RelativeAngularVel())});
  }

  /// Variance of the mean over `seconds` due to the wheels' noise; at least a small value for a
  /// robot at rest, as a variance of 0 is unusable.
  [[nodiscard]] Eigen::Vector2d velocity_variance(const BodyVelocity& velocity,
                                                  double seconds) const {
    constexpr double kLeast = 1e-8;
    const OdometrySettings& settings = parameters_.odometry;
    const double track = settings.drive.track_m;
    const double path = (std::abs(velocity.forward) + std::abs(velocity.turn) * track / 2.0);
    const double side = settings.wheel_noise * settings.wheel_noise * path / seconds;
    return {side / 2.0 + kLeast, 2.0 * side / (track * track) + kLeast};
  }

  void drive(Time now) {
    if (const std::optional<BodyVelocity> command = publisher_.take_command()) {
      if (!run_->driver.command(*command, now) && !warned_) {
        gzwarn << place_ << ": a cmd_vel that is not finite is ignored\n";
        warned_ = true;
      }
    }
    const PlanarPose pose = planar(from_gazebo(base_->WorldPose()));
    wheels_.drive(run_->driver.next(pose, now));
    if (run_->driver.finished() != run_->finished) {
      run_->finished = run_->driver.finished();
      publisher_.publish_path_finished(run_->finished);
    }
  }

  gazebo::physics::ModelPtr model_;
  gazebo::physics::WorldPtr world_;
  RobotParameters parameters_;
  std::string place_;
  gazebo::physics::LinkPtr base_;
  SkidSteer wheels_;
  std::shared_ptr<RosLink> ros_;
  RobotPublisher publisher_;
  std::optional<ros2::RobotTopics> recorded_;
  Duration odometry_interval_ = duration_from_seconds(1.0 / parameters_.odometry_rate_hz);
  std::optional<Laser> laser_;
  std::optional<Run> run_;
  std::atomic<bool> restart_{false};
  bool warned_ = false;
};

}  // namespace

/// Plugin for a Robot. If a parameter is invalid, it reports that and does nothing.
class RobotPlugin final : public gazebo::ModelPlugin {
 public:
  void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr element) override {
    const std::string place = place_of(*model, element);
    try {
      const auto given = plugin_parameters(*model, element, kFile);
      if (!given) return;
      Diagnostics diagnostics;
      const RobotParameters parameters = robot_from(*given, diagnostics);
      for (const std::string& warning : diagnostics.warnings()) {
        gzwarn << place << ": " << warning << "\n";
      }
      robot_ = std::make_unique<Robot>(model, parameters, place);
      step_ = gazebo::event::Events::ConnectWorldUpdateEnd([this] { robot_->step(); });
    } catch (const Error& error) {
      gzerr << place << ": " << error.what() << "\n";
    }
  }

  void Reset() override {
    if (robot_) robot_->restart();
  }

 private:
  std::unique_ptr<Robot> robot_;
  gazebo::event::ConnectionPtr step_;
};

GZ_REGISTER_MODEL_PLUGIN(RobotPlugin)

}  // namespace tagfield
