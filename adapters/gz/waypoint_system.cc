// SPDX-License-Identifier: Apache-2.0
// libtagfield-gz.so, tagfield::systems::Waypoints: drives a model with gz-sim's DiffDrive along
// waypoints. In <model>:
//
//     <plugin filename="tagfield-gz" name="tagfield::systems::Waypoints">
//       <path><waypoint>1 0</waypoint><waypoint>1 3</waypoint></path>   <!-- m, world -->
//       <speed>0.3</speed> <look_ahead>0.5</look_ahead>   <!-- and the other settings of driving in
//                                                  tagfield/motion/robot_parameters.h -->
//       <topic>cmd_vel</topic>          <!-- of DiffDrive; default /model/NAME/cmd_vel -->
//       <stop_at_end>false</stop_at_end>  <!-- the server ends with the path; false -->
//     </plugin>
#define TAGFIELD_NEXT_SYSTEM
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <sdf/Element.hh>

#include "adapters/gazebo_common/conversions.h"
#include "adapters/gazebo_common/sdf_elements.h"
#include "adapters/gz/entities.h"
#include "tagfield/base/error.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/motion/robot_parameters.h"

namespace tagfield::systems {

class Waypoints final : public gz_sim::System,
                        public gz_sim::ISystemConfigure,
                        public gz_sim::ISystemPreUpdate,
                        public ISystemReset {
 public:
  void Configure(const gz_sim::Entity& model, const std::shared_ptr<const sdf::Element>& sdf,
                 gz_sim::EntityComponentManager& ecm, gz_sim::EventManager& events) override {
    const std::string place = fmt::format("model '{}', plugin 'Waypoints'", name_of(model, ecm));
    try {
      configure(model, sdf->Clone(), ecm, place);
    } catch (const Error& error) {
      tell_error(fmt::format("{}: {}; stands still", place, error.what()));
      parameters_.reset();
    }
    events_ = &events;
  }

  void PreUpdate(const gz_sim::UpdateInfo& info, gz_sim::EntityComponentManager& ecm) override {
    if (!parameters_ || info.paused) return;
    const Time now(info.simTime);
    if (!driver_ || now < last_) start(planar(from_gazebo(gz_sim::worldPose(model_, ecm))), now);
    last_ = now;
    if (is_done_ || (sent_ && now - *sent_ < parameters_->driver.steering_interval)) return;
    sent_ = now;
    send(driver_->next(planar(from_gazebo(gz_sim::worldPose(model_, ecm))), now));
    is_done_ = driver_->finished();
    if (!is_done_) return;
    send({});
    if (stops_at_end_) events_->Emit<gz_sim::events::Stop>();
  }

  void Reset(const gz_sim::UpdateInfo& /*info*/, gz_sim::EntityComponentManager& /*ecm*/) override {
    driver_.reset();
  }

 private:
  void configure(gz_sim::Entity model, const sdf::ElementPtr& plugin,
                 const gz_sim::EntityComponentManager& ecm, const std::string& place) {
    model_ = model;
    stops_at_end_ = plugin->Get<bool>("stop_at_end", false).first;
    const std::string topic =
        plugin->Get<std::string>("topic", "/model/" + name_of(model, ecm) + "/cmd_vel").first;
    for (const char* const own : {"topic", "stop_at_end"}) {
      for (const sdf::ElementPtr& element : children(plugin, own)) element->RemoveFromParent();
    }
    Diagnostics diagnostics;
    parameters_ = robot_from(parameters_in(plugin), diagnostics);
    for (const std::string& warning : diagnostics.warnings()) {
      report_warning(fmt::format("{}: {}", place, warning));
    }
    commands_ = node_.Advertise<gz_msgs::Twist>(topic);
    if (!commands_) throw Error(fmt::format("<topic> is '{}', expected a topic's name", topic));
  }

  void start(const PlanarPose& pose, Time now) {
    driver_.emplace(parameters_->driver);
    driver_->set_path(PathFollower(pose, parameters_->waypoints, parameters_->style));
    last_ = now;
    sent_.reset();
    is_done_ = parameters_->waypoints.empty();
  }

  void send(const BodyVelocity& velocity) {
    gz_msgs::Twist twist;
    twist.mutable_linear()->set_x(velocity.forward);
    twist.mutable_angular()->set_z(velocity.turn);
    commands_.Publish(twist);
  }

  gz_sim::Entity model_ = gz_sim::kNullEntity;
  gz_sim::EventManager* events_ = nullptr;
  gz_transport::Node node_;
  gz_transport::Node::Publisher commands_;
  std::optional<RobotParameters> parameters_;
  bool stops_at_end_ = false;
  std::optional<RobotDriver> driver_;
  Time last_;
  std::optional<Time> sent_;
  bool is_done_ = false;
};

}  // namespace tagfield::systems

TAGFIELD_ADD_SYSTEM(tagfield::systems::Waypoints, tagfield::systems::Waypoints::ISystemConfigure,
                    tagfield::systems::Waypoints::ISystemPreUpdate,
                    tagfield::systems::Waypoints::ISystemReset)
