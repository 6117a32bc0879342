// SPDX-License-Identifier: Apache-2.0
// A system plugin for tests: writes down where all collisions of the world are before its first
// step, and ends the server. The environment's TAGFIELD_POSES names the file; a line a collision:
//
//   NAME<tab>x y z qx qy qz qw
#include <cstdlib>
#include <fstream>
#include <gazebo/common/Console.hh>
#include <gazebo/common/Events.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/physics/physics.hh>
#include <iomanip>

namespace gazebo {

class PosesPlugin : public SystemPlugin {
 public:
  void Load(int /*argc*/, char** /*argv*/) override {
    before_step_ = event::Events::ConnectWorldUpdateBegin([](const common::UpdateInfo& info) {
      const physics::WorldPtr world = physics::get_world(info.worldName);
      std::ofstream file(std::getenv("TAGFIELD_POSES"));
      file << std::setprecision(17);
      for (const physics::ModelPtr& model : world->Models()) write(*model, file);
      file << "end" << std::endl;
      std::_Exit(0);
    });
  }

 private:
  static void write(const physics::Model& model, std::ostream& file) {
    for (const physics::LinkPtr& link : model.GetLinks()) {
      for (const physics::CollisionPtr& collision : link->GetCollisions()) {
        const ignition::math::Pose3d pose = collision->WorldPose();
        const ignition::math::Quaterniond& q = pose.Rot();
        file << collision->GetScopedName() << '\t' << pose.Pos() << ' ' << q.X() << ' ' << q.Y()
             << ' ' << q.Z() << ' ' << q.W() << '\n';
      }
    }
    for (const physics::ModelPtr& nested : model.NestedModels()) write(*nested, file);
  }

  event::ConnectionPtr before_step_;
};

GZ_REGISTER_SYSTEM_PLUGIN(PosesPlugin)

}  // namespace gazebo
