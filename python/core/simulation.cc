// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/simulation.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cmath>

#include "python/core/calls.h"
#include "python/core/listener.h"
#include "python/core/loaded.h"
#include "python/core/tables.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/scenario/driven_robot.h"
#include "tagfield/simulator/remote_driver.h"
#include "tagfield/simulator/robot.h"

namespace tagfield::python {
namespace {

/// Python drives a robot: by a velocity that holds until another is given, or by a function.
class PythonDriver final : public RemoteControl {
 public:
  explicit PythonDriver(Held policy) : policy_(std::move(policy)) {}

  BodyVelocity wanted(Time now) override {
    if (policy_) {
      const py::gil_scoped_acquire lock;
      const auto [forward, turn] = py::cast<std::pair<double, double>>((*policy_)(to_seconds(now)));
      drive(forward, turn);
    }
    return velocity_;
  }
  void on_odometry(const OdometryReport& report) override { odometry_ = report.pose; }
  void on_scan(const LaserScan& scan) override { scan_ = scan; }

  void drive(double forward_m_s, double turn_rad_s) {
    if (!std::isfinite(forward_m_s) || !std::isfinite(turn_rad_s)) {
      throw Error("a robot's velocity must be two finite numbers [m/s, rad/s]");
    }
    velocity_ = {forward_m_s, turn_rad_s};
  }
  [[nodiscard]] const PlanarPose& odometry() const { return odometry_; }
  [[nodiscard]] const std::optional<LaserScan>& scan() const { return scan_; }

 private:
  Held policy_;
  BodyVelocity velocity_;
  PlanarPose odometry_;
  std::optional<LaserScan> scan_;
};

/// A simulation with all that it must not outlive.
class Stepping {
 public:
  Stepping(LoadedPtr loaded, std::uint64_t seed, const py::list& outlets, const std::string& robot,
           const py::object& policy)
      : loaded_(std::move(loaded)), scenario_(loaded_->parts.scenario) {
    Outlets attached;
    attach(std::make_shared<TableRecorder>(tables_), attached);
    for (const py::handle outlet : outlets) {
      attach_python(py::reinterpret_borrow<py::object>(outlet), attached);
    }
    if (scenario_.pose.source == PoseSource::kSlam) {
      throw Error("step by step, robots don't map: navigation must be truth, noisy or odometry");
    }
    const RemoteDriving* driving = nullptr;
    if (!robot.empty()) {
      driver_ = std::make_shared<PythonDriver>(policy.is_none() ? nullptr : held(policy));
      driving_ = {robot,
                  driver_,
                  {std::make_shared<const RayScene>(loaded_->parts.scene), scenario_.obstacles}};
      driving = &driving_;
      let_be_driven(robot, scenario_, diagnostics_);
    }
    simulation_.emplace(scenario_, seed, attached, nullptr, driving);
  }

  void step(int count) {
    const py::gil_scoped_release unlocked;
    for (int i = 0; i < count && !simulation_->finished(); ++i) {
      simulation_->step();
      has_stepped_ = true;
    }
    if (simulation_->finished()) simulation_->finish();
  }

  /// What came since the last call.
  py::dict take() {
    RunTables taken;
    std::swap(taken, tables_);
    // Names go on counting where they are.
    tables_.readers = taken.readers;
    tables_.antennas = taken.antennas;
    tables_.tags = taken.tags;
    tables_.robots = taken.robots;
    return to_python(std::move(taken));
  }

  /// What does not hold as the scenario states it.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return diagnostics_.warnings(); }

  PythonDriver& driver() {
    if (driver_) return *driver_;
    throw Error("no robot is driven: give simulation() its name as robot=");
  }

  /// x, y [m], yaw [rad] in the world, at the last step's end.
  [[nodiscard]] Eigen::Vector3d robot_pose(const std::string& name, bool believed) const {
    for (const Robot& robot : simulation_->robots()) {
      if (robot.name() != name) continue;
      const double seconds = has_stepped_ ? scenario_.time_step_s : 0.0;
      const PlanarPose pose =
          planar(believed ? robot.believed_pose(seconds) : robot.true_pose(seconds));
      return {pose.x, pose.y, pose.yaw};
    }
    throw Error("there is no robot '" + name + "'");
  }

  void add_tag(const std::string& id, const Eigen::Vector3d& position_m,
               const Eigen::Vector3d& rpy_rad) {
    TagSpec tag;
    tag.id = id;
    if (!scenario_.tags.empty()) tag.model = scenario_.tags.front().model;
    tag.motion = {{Time{}, from_xyz_rpy(finite(position_m), finite(rpy_rad))}};
    simulation_->add_tag(tag);
  }
  void move_tag(const std::string& id, const Eigen::Vector3d& position_m,
                const Eigen::Vector3d& rpy_rad) {
    simulation_->move_tag(id, from_xyz_rpy(finite(position_m), finite(rpy_rad)));
  }
  Simulation& simulation() { return *simulation_; }

 private:
  static const Eigen::Vector3d& finite(const Eigen::Vector3d& vector) {
    if (vector.allFinite()) return vector;
    throw Error("a tag's position_m and rpy_rad must be finite");
  }

  LoadedPtr loaded_;
  Scenario scenario_;
  Diagnostics diagnostics_;
  RunTables tables_;
  std::shared_ptr<PythonDriver> driver_;
  RemoteDriving driving_;
  std::optional<Simulation> simulation_;
  bool has_stepped_ = false;
};

/// Ranges [m] by beam, or None before the first scan; 0 for beams without meaning.
py::object scan_of(Stepping& self) {
  const std::optional<LaserScan>& scan = self.driver().scan();
  if (!scan) return py::none();
  return py::make_tuple(
      to_seconds(scan->stamp), scan->first_angle_rad, scan->angle_step_rad, scan->max_range_m,
      owned_array(scan->ranges_m, {static_cast<py::ssize_t>(scan->ranges_m.size())}));
}

}  // namespace

void bind_simulation(py::module_& module) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  py::class_<Stepping>(module, "Simulation")
      .def(py::init<LoadedPtr, std::uint64_t, py::list, std::string, py::object>(),
           py::arg("loaded"), py::arg("seed"), py::arg("outlets"), py::arg("robot"),
           py::arg("policy").none(true))
      .def("step", &Stepping::step, py::arg("count"))
      .def("take", &Stepping::take)
      .def("drive",
           [](Stepping& self, double forward, double turn) { self.driver().drive(forward, turn); })
      .def_property_readonly("odometry",
                             [](Stepping& self) {
                               const PlanarPose& pose = self.driver().odometry();
                               return Eigen::Vector3d(pose.x, pose.y, pose.yaw);
                             })
      .def_property_readonly("scan", &scan_of)
      .def_property_readonly("warnings", &Stepping::warnings)
      .def("robot_pose", &Stepping::robot_pose, py::arg("name"), py::arg("believed"))
      .def_property_readonly("now_s",
                             [](Stepping& self) { return to_seconds(self.simulation().now()); })
      .def_property_readonly("finished",
                             [](Stepping& self) { return self.simulation().finished(); })
      .def_property_readonly("progress",
                             [](Stepping& self) { return self.simulation().progress(); })
      .def("add_tag", &Stepping::add_tag, py::arg("id"), py::arg("position_m"),
           py::arg("rpy_rad") = zero)
      .def("move_tag", &Stepping::move_tag, py::arg("id"), py::arg("position_m"),
           py::arg("rpy_rad") = zero)
      .def("remove_tag",
           [](Stepping& self, const std::string& id) { self.simulation().remove_tag(id); })
      .def("has_tag",
           [](Stepping& self, const std::string& id) { return self.simulation().has_tag(id); });
}

}  // namespace tagfield::python
