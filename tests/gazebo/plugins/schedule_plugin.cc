// SPDX-License-Identifier: Apache-2.0
// A world plugin for tests: does things at given simulated times, and writes down which models
// there really are. Its SDF holds
//
//   <log>FILE</log>                                    where to write, a line an event:
//                                                      STAMP_NS + NAME, STAMP_NS - NAME,
//                                                      STAMP_NS stopped
//   <insert time="1.5">SDF text or a file's path</insert>
//   <remove time="2.0">MODEL</remove>
//   <move time="0.5" model="NAME" velocity="vx vy vz"/>  from then on, by setting its pose
//   <reset time="3.0"/>                                 of the world's time and poses
//   <stop time="9.0"/>                                  pauses the world
#include <fstream>
#include <gazebo/common/Console.hh>
#include <gazebo/common/Events.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace gazebo {

class SchedulePlugin : public WorldPlugin {
 public:
  void Load(physics::WorldPtr world, sdf::ElementPtr sdf) override {
    world_ = world;
    node_ = transport::NodePtr(new transport::Node());
    node_->Init(world->Name());
    if (sdf->HasElement("log")) log_.open(sdf->Get<std::string>("log"));
    for (sdf::ElementPtr event = sdf->GetFirstElement(); event; event = event->GetNextElement()) {
      if (event->HasAttribute("time")) events_.emplace(event->Get<double>("time"), event);
    }
    begin_ = event::Events::ConnectWorldUpdateBegin(
        [this](const common::UpdateInfo& info) { before_step(info.simTime); });
    end_ = event::Events::ConnectWorldUpdateEnd([this] { after_step(); });
  }

 private:
  struct Motion {
    std::string model;
    ignition::math::Vector3d velocity;
    common::Time since;
    ignition::math::Pose3d from;
  };

  void before_step(const common::Time& now) {
    while (!events_.empty() && events_.begin()->first <= now.Double() + 1e-9) {
      const sdf::ElementPtr event = events_.begin()->second;
      events_.erase(events_.begin());
      act(event, now);
    }
    for (const Motion& motion : motions_) {
      const physics::ModelPtr model = world_->ModelByName(motion.model);
      if (!model) continue;
      ignition::math::Pose3d pose = motion.from;
      pose.Pos() += motion.velocity * (now - motion.since).Double();
      model->SetWorldPose(pose);
    }
  }

  void act(const sdf::ElementPtr& event, const common::Time& now) {
    const std::string what = event->GetName();
    if (what == "insert") {
      const auto text = event->Get<std::string>();
      if (text.find('<') == std::string::npos) {
        world_->InsertModelFile(text);
      } else {
        world_->InsertModelString(text);
      }
    } else if (what == "remove") {
      // As Gazebo's own window and gazebo_ros ask for it.
      transport::requestNoReply(node_, "entity_delete", event->Get<std::string>());
    } else if (what == "move") {
      const auto name = event->Get<std::string>("model");
      motions_.push_back({name, event->Get<ignition::math::Vector3d>("velocity"), now,
                          world_->ModelByName(name)->WorldPose()});
    } else if (what == "reset") {
      motions_.clear();
      world_->Reset();
    } else if (what == "stop") {
      world_->SetPaused(true);
      write(now, "stopped");
    }
  }

  void after_step() {
    std::set<std::string> present;
    for (const physics::ModelPtr& model : world_->Models()) present.insert(model->GetName());
    if (present == present_) return;
    const common::Time now = world_->SimTime();
    for (const std::string& name : present) {
      if (present_.count(name) == 0) write(now, "+ " + name);
    }
    for (const std::string& name : present_) {
      if (present.count(name) == 0) write(now, "- " + name);
    }
    present_ = present;
  }

  void write(const common::Time& now, const std::string& event) {
    log_ << static_cast<std::int64_t>(now.sec) * 1'000'000'000 + now.nsec << " " << event << "\n";
    log_.flush();
  }

  physics::WorldPtr world_;
  transport::NodePtr node_;
  std::ofstream log_;
  std::multimap<double, sdf::ElementPtr> events_;
  std::vector<Motion> motions_;
  std::set<std::string> present_;
  event::ConnectionPtr begin_;
  event::ConnectionPtr end_;
};

GZ_REGISTER_WORLD_PLUGIN(SchedulePlugin)

}  // namespace gazebo
