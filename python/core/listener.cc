// SPDX-License-Identifier: Apache-2.0
#include "python/core/listener.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <deque>

#include "python/core/calls.h"
#include "tagfield/base/error.h"

namespace tagfield::python {
namespace {

/// Calls the methods that the Python object has.
class PythonListener final : public ReadListener, public PoseListener, public TruthListener {
 public:
  explicit PythonListener(const py::object& outlet) {
    const bool is_function = !py::hasattr(outlet, "on_read") && PyCallable_Check(outlet.ptr()) != 0;
    read_ = is_function ? held(outlet) : method(outlet, "on_read");
    update_ = method(outlet, "on_update");
    antenna_added_ = method(outlet, "on_antenna_added");
    antenna_removed_ = method(outlet, "on_antenna_removed");
    pose_ = method(outlet, "on_pose");
    tag_added_ = method(outlet, "on_tag_added");
    tag_moved_ = method(outlet, "on_tag_moved");
    tag_removed_ = method(outlet, "on_tag_removed");
    robot_pose_ = method(outlet, "on_robot_pose");
    antenna_pose_ = method(outlet, "on_antenna_pose");
    distance_ = method(outlet, "on_distance");
    for (const Held* any :
         {&read_, &update_, &antenna_added_, &antenna_removed_, &pose_, &tag_added_, &tag_moved_,
          &tag_removed_, &robot_pose_, &antenna_pose_, &distance_}) {
      if (*any) return;
    }
    throw Error("an outlet must be a function of a read, or have methods of tagfield.Outlet");
  }

  void on_read(const TagRead& read) override {
    if (!distances_.empty()) {
      const TrueDistance& distance = distances_.front();
      call(distance_, to_seconds(distance.stamp), distance.antenna, distance.tag,
           distance.distance_m);
      distances_.pop_front();
    }
    call(read_, read);
  }
  void on_update(const AntennaInfo& antenna, Time stamp) override {
    call(update_, antenna.name, to_seconds(stamp));
  }
  void on_antenna_added(const AntennaInfo& antenna) override { call(antenna_added_, antenna.name); }
  void on_antenna_removed(const std::string& name) override { call(antenna_removed_, name); }
  void on_pose(const AntennaInfo& /*antenna*/, const AntennaPose& pose) override {
    call(pose_, pose);
  }
  void on_tag_added(const TagPosition& tag, const std::string& /*label*/) override {
    call(tag_added_, tag);
  }
  void on_tag_moved(const TagPosition& tag) override { call(tag_moved_, tag); }
  void on_tag_removed(const std::string& id) override { call(tag_removed_, id); }
  void on_robot_pose(const AntennaPose& robot) override { call(robot_pose_, robot); }
  void on_antenna_pose(const AntennaInfo& /*antenna*/, const AntennaPose& pose) override {
    call(antenna_pose_, pose);
  }
  // Many may come at once; each is reported right before its read.
  void on_distance(const TrueDistance& distance) override {
    if (distance_) distances_.push_back(distance);
  }

 private:
  static Held method(const py::object& outlet, const char* name) {
    return py::hasattr(outlet, name) ? held(outlet.attr(name)) : nullptr;
  }

  template <class... Arguments>
  static void call(const Held& function, const Arguments&... arguments) {
    if (!function) return;
    const py::gil_scoped_acquire lock;
    (*function)(arguments...);
  }

  Held read_, update_, antenna_added_, antenna_removed_, pose_, tag_added_, tag_moved_,
      tag_removed_, robot_pose_, antenna_pose_, distance_;
  std::deque<TrueDistance> distances_;  ///< Of reads that are still to come.
};

}  // namespace

void bind_records(py::module_& module) {
  py::class_<TagRead>(module, "Read", "One read of one tag, as a reader reports it.")
      .def_property_readonly(
          "stamp_s", [](const TagRead& read) { return to_seconds(read.stamp); },
          "When the tag answered [s].")
      .def_property_readonly(
          "stamp_ns", [](const TagRead& read) { return read.stamp.time_since_epoch().count(); },
          "The same [ns], exact.")
      .def_readonly("reader", &TagRead::reader, "Name of the reader.")
      .def_readonly("antenna", &TagRead::antenna, "Name of the antenna.")
      .def_readonly("tag", &TagRead::tag, "The tag's ID.")
      .def_readonly("frequency_hz", &TagRead::frequency_hz, "Carrier [Hz].")
      .def_readonly("phase_rad", &TagRead::phase_rad, "In [0, 2π), growing with distance [rad].")
      .def_readonly("rssi_dbm", &TagRead::rssi_dbm, "[dBm]")
      .def_readonly("doppler_hz", &TagRead::doppler_hz, "[Hz], or None where it is not reported.")
      .def("__repr__", [](const TagRead& read) {
        return py::str(
                   "Read(stamp_s={:.9f}, antenna={!r}, tag={!r}, phase_rad={:.4f}, "
                   "rssi_dbm={:.1f})")
            .format(to_seconds(read.stamp), read.antenna, read.tag, read.phase_rad, read.rssi_dbm);
      });
  py::class_<AntennaPose>(module, "Pose", "Where an antenna, or a robot, was at one time.")
      .def_property_readonly(
          "stamp_s", [](const AntennaPose& pose) { return to_seconds(pose.stamp); }, "[s]")
      .def_readonly("name", &AntennaPose::antenna, "Of the antenna or robot.")
      .def_property_readonly(
          "position_m", [](const AntennaPose& pose) { return pose.X_WA.translation; },
          "(3,) x, y, z [m, world].")
      .def_property_readonly(
          "quaternion_xyzw", [](const AntennaPose& pose) { return pose.X_WA.rotation.coeffs(); },
          "(4,) rotation from the antenna's frame to the world.");
  py::class_<TagPosition>(module, "Place", "Where a tag was from a time on.")
      .def_property_readonly(
          "stamp_s", [](const TagPosition& tag) { return to_seconds(tag.stamp); }, "[s]")
      .def_readonly("tag", &TagPosition::tag, "The tag's ID.")
      .def_property_readonly(
          "position_m", [](const TagPosition& tag) { return tag.p_WT; },
          "(3,) x, y, z [m, world].");
}

void attach_python(const py::object& outlet, Outlets& outlets) {
  attach(std::make_shared<PythonListener>(outlet), outlets);
}

}  // namespace tagfield::python
