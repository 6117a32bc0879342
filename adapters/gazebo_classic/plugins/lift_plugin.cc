// SPDX-License-Identifier: Apache-2.0
// libTagfieldLiftPlugin.so: drives a prismatic joint up and down, or to a commanded height.
// Parameters: tagfield/motion/robot_parameters.h.
#include <atomic>
#include <gazebo/common/Console.hh>
#include <gazebo/common/Events.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/physics/physics.hh>
#include <memory>
#include <optional>

#include "adapters/gazebo_classic/conversions.h"
#include "adapters/gazebo_classic/laser.h"
#include "adapters/gazebo_classic/lift_drive.h"
#include "adapters/gazebo_classic/plugin_elements.h"
#include "adapters/gazebo_classic/skid_steer.h"
#include "adapters/ros1/robot_publisher.h"
#include "adapters/ros1/ros_link.h"
#include "tagfield/motion/robot_parameters.h"

namespace tagfield {
namespace {

constexpr const char* kFile = "libTagfieldLiftPlugin.so";

/// State that is reset with each start of the world.
struct Run {
  LiftGuide guide;
  Time start;
  Time last;
};

/// One lift in its world.
class LiftOfModel {
 public:
  LiftOfModel(const gazebo::physics::ModelPtr& model, LiftParameters parameters, std::string place)
      : world_(model->GetWorld()),
        parameters_(std::move(parameters)),
        place_(std::move(place)),
        drive_(*model, parameters_.joint, parameters_.force_n),
        ros_(RosLink::shared()),
        publisher_(ros_, parameters_.name_space, parameters_.topic, parameters_.joint) {
    expect_ode(*world_);
  }

  /// To be called at the beginning of each step of the world; `end` is the time of its end.
  void begin_step(Time end) {
    const double seconds = world_->Physics()->GetMaxStepSize();
    if (restart_.exchange(false) || !run_ || end < run_->last) {
      const Time now = end - duration_from_seconds(seconds);
      run_ = Run{LiftGuide(parameters_.lift), now, now};
    }
    obey();
    const double height = run_->guide.height(Time(end - run_->start));
    drive_.go(parameters_.lower_m + height, seconds);
  }

  /// To be called at the end of the step.
  void end_step() {
    if (!run_) return;
    const Time now = from_gazebo(world_->SimTime());
    ros_->advance_clock(now);
    if (is_due(run_->last, now, interval_)) {
      publisher_.publish(now, drive_.position(), drive_.speed());
    }
    run_->last = now;
  }

  void restart() { restart_ = true; }

 private:
  void obey() {
    const std::optional<double> position = publisher_.take_command();
    if (!position || run_->guide.go_to(*position - parameters_.lower_m) || warned_) return;
    gzwarn << place_ << ": a height that is not finite is ignored\n";
    warned_ = true;
  }

  gazebo::physics::WorldPtr world_;
  LiftParameters parameters_;
  std::string place_;
  LiftDrive drive_;
  std::shared_ptr<RosLink> ros_;
  LiftPublisher publisher_;
  Duration interval_ = duration_from_seconds(1.0 / parameters_.joint_states_rate_hz);
  std::optional<Run> run_;
  std::atomic<bool> restart_{false};
  bool warned_ = false;
};

}  // namespace

/// Plugin for a lift. If a parameter is invalid, it reports that and does nothing.
class LiftPlugin final : public gazebo::ModelPlugin {
 public:
  void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr element) override {
    const std::string place = place_of(*model, element);
    try {
      const std::vector<RawParameter> given = parameters_in(element);
      Diagnostics diagnostics;
      const LiftParameters parameters = lift_from(given, diagnostics);
      for (const std::string& warning : diagnostics.warnings()) {
        gzwarn << place << ": " << warning << "\n";
      }
      lift_ = std::make_unique<LiftOfModel>(model, parameters, place);
      begin_ = gazebo::event::Events::ConnectWorldUpdateBegin(
          [this](const gazebo::common::UpdateInfo& info) {
            lift_->begin_step(from_gazebo(info.simTime));
          });
      end_ = gazebo::event::Events::ConnectWorldUpdateEnd([this] { lift_->end_step(); });
    } catch (const Error& error) {
      gzerr << place << ": " << error.what() << "\n";
    }
  }

  void Reset() override {
    if (lift_) lift_->restart();
  }

 private:
  std::unique_ptr<LiftOfModel> lift_;
  gazebo::event::ConnectionPtr begin_;
  gazebo::event::ConnectionPtr end_;
};

GZ_REGISTER_MODEL_PLUGIN(LiftPlugin)

}  // namespace tagfield
