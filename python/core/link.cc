// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "apps/tagfield/scenario_arguments.h"
#include "python/core/arrays.h"
#include "python/core/loaded.h"
#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/channel/paper_model.h"
#include "tagfield/channel/paper_signals.h"
#include "tagfield/channel/radio_world.h"
#include "tagfield/field/radio_port.h"
#include "tagfield/planning/link_explanation.h"
#include "tagfield/planning/moment.h"

namespace tagfield::python {
namespace {

/// One antenna at one place, and the links to tags anywhere. Without noise.
class AntennaLinks {
 public:
  virtual ~AntennaLinks() = default;
  /// Into rows of the same length.
  virtual void links(std::span<const Eigen::Vector3d> places, std::span<LinkRow> rows) = 0;
};

class PaperLinksFrom final : public AntennaLinks {
 public:
  PaperLinksFrom(const PaperAntenna& antenna, const Eigen::Vector3d& p_WA)
      : antenna_(antenna), p_WA_(p_WA) {
    antenna_.model.phase_noise_rad = 0.0;
    antenna_.model.rssi_noise = 0.0;
  }

  void links(std::span<const Eigen::Vector3d> places, std::span<LinkRow> rows) override {
    const std::size_t count = places.size();
    distance_m_.resize(count);
    words_.resize(count);
    phase_rad_.resize(count);
    rssi_dbm_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      distance_m_[i] = link_between(p_WA_, places[i]).distance_m;
    }
    paper_signals(antenna_.model, {distance_m_, words_, words_, {}}, phase_rad_, rssi_dbm_);
    for (std::size_t i = 0; i < count; ++i) {
      const bool readable =
          distance_m_[i] <= antenna_.range_m &&
          (!antenna_.sensitivity_dbm || rssi_dbm_[i] >= *antenna_.sensitivity_dbm);
      rows[i] = {distance_m_[i], kUnknown, rssi_dbm_[i], phase_rad_[i], readable};
    }
  }

 private:
  PaperAntenna antenna_;
  Eigen::Vector3d p_WA_;
  std::vector<double> distance_m_, phase_rad_, rssi_dbm_;
  std::vector<std::uint64_t> words_;
};

class PhysicalLinksFrom final : public AntennaLinks {
 public:
  PhysicalLinksFrom(const LoadedPtr& loaded, const AntennaSpec& antenna, const TagSpec& tag,
                    const RigidTransform& X_WA, const Eigen::Quaterniond& R_WT, Time time)
      : loaded_(loaded),
        model_(*physical(antenna.parameters)),
        tag_(tag.model ? tag.model : default_tag_model()),
        port_(port_of(loaded->parts.scenario, antenna.parameters, loaded->parts.scenario.seed)),
        carrier_(carrier_at(model_, port_, time)),
        view_(view_from(model_, *loaded->parts.scenario.radio_world, X_WA, carrier_.frequency_hz,
                        port_.antenna_key, port_.seed)),
        p_WA_(X_WA.translation),
        R_WT_(R_WT),
        key_(stream_key(tag.id)) {}

  void links(std::span<const Eigen::Vector3d> places, std::span<LinkRow> rows) override {
    if (places.size() == 1) {
      rows[0] = row_of(places[0], link_of(view_, end_at(places[0]), paths_));
      return;
    }
    for (std::size_t begin = 0; begin < places.size(); begin += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, places.size() - begin);
      some_links(places.subspan(begin, count), rows.subspan(begin, count));
    }
  }

 private:
  static constexpr std::size_t kAtOnce = 512;  ///< So few that they stay in the cache.

  void some_links(std::span<const Eigen::Vector3d> places, std::span<LinkRow> rows) {
    ends_.clear();
    for (const Eigen::Vector3d& place : places) ends_.push_back(end_at(place));
    links_.resize(places.size());
    links_of(view_, ends_, paths_, links_);
    for (std::size_t i = 0; i < places.size(); ++i) rows[i] = row_of(places[i], links_[i]);
  }
  [[nodiscard]] TagEnd end_at(const Eigen::Vector3d& p_WT) const {
    return {*tag_, {R_WT_, p_WT}, key_};
  }
  [[nodiscard]] LinkRow row_of(const Eigen::Vector3d& p_WT, const RadioLink& link) const {
    const Reply reply = reply_of(link, carrier_.phase_offset_rad, Eigen::Vector3d::Zero());
    return {(p_WT - p_WA_).norm(), link.tag_dbm, link.reply_dbm, wrap_to_two_pi(reply.phase_rad),
            is_heard(link, *tag_, model_)};
  }

  LoadedPtr loaded_;
  const RadioModel& model_;
  std::shared_ptr<const TagModel> tag_;
  RadioPort port_;
  CarrierNow carrier_;
  RadioView view_;
  std::vector<RadioPath> paths_;
  std::vector<TagEnd> ends_;
  std::vector<RadioLink> links_;
  Eigen::Vector3d p_WA_;
  Eigen::Quaterniond R_WT_;
  std::uint64_t key_;
};

std::unique_ptr<AntennaLinks> links_from(const LoadedPtr& loaded, const std::string& antenna,
                                         const std::string& tag, double time_s,
                                         const Eigen::Vector3d& tag_rpy_rad) {
  const py::gil_scoped_release unlocked;
  Diagnostics unheard;
  const Scenario& scenario = loaded->parts.scenario;
  const AntennaSpec& from = antenna_named("link", scenario, antenna);
  const TagSpec& to = tag.empty() ? scenario.tags.front() : tag_named("link", scenario, tag);
  const Time time = time_from_seconds(time_s);
  const Simulation simulation = simulation_at(as_planned(scenario, unheard), scenario.seed, time);
  const RigidTransform X_WA = simulation.antenna_pose(from, time);
  if (physical(from.parameters) == nullptr) {
    return std::make_unique<PaperLinksFrom>(paper(from.parameters), X_WA.translation);
  }
  const Eigen::Quaterniond R_WT = from_xyz_rpy(Eigen::Vector3d::Zero(), tag_rpy_rad).rotation;
  return std::make_unique<PhysicalLinksFrom>(loaded, from, to, X_WA, R_WT, time);
}

void require_finite(const Eigen::Vector3d& place) {
  if (!place.allFinite()) throw Error("link: a position must be three finite numbers [m]");
}

LinkRow one_link(AntennaLinks& self, double x_m, double y_m, double z_m) {
  const Eigen::Vector3d place(x_m, y_m, z_m);
  require_finite(place);
  LinkRow row{};
  self.links({&place, 1}, {&row, 1});
  return row;
}

using PlacesArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

py::object batch(AntennaLinks& self, const PlacesArray& positions_m) {
  if (positions_m.ndim() != 2 || positions_m.shape(1) != 3) {
    throw Error("link: positions_m must be of shape (N, 3)");
  }
  const auto count = static_cast<std::size_t>(positions_m.shape(0));
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  const std::span<const Eigen::Vector3d> places(
      reinterpret_cast<const Eigen::Vector3d*>(positions_m.data()), count);
  std::vector<LinkRow> rows(count);
  {
    const py::gil_scoped_release unlocked;
    for (const Eigen::Vector3d& place : places) require_finite(place);
    self.links(places, rows);
  }
  return table(std::move(rows), {});
}

}  // namespace

void bind_links(py::module_& module) {
  py::class_<LinkRow>(module, "LinkState", "A link's powers and phase, without noise.")
      .def_readonly("distance_m", &LinkRow::distance_m, "From the antenna to the tag [m].")
      .def_readonly("tag_dbm", &LinkRow::tag_dbm, "At the chip [dBm]; NaN by the paper's model.")
      .def_readonly("reply_dbm", &LinkRow::reply_dbm, "At the reader's port: its RSSI [dBm].")
      .def_readonly("phase_rad", &LinkRow::phase_rad, "In [0, 2π), growing with distance [rad].")
      .def_readonly("readable", &LinkRow::readable, "Whether tag and reader have enough power.")
      .def("__repr__", [](const LinkRow& row) {
        return py::str(
                   "LinkState(distance_m={:.3f}, tag_dbm={:.2f}, reply_dbm={:.2f}, "
                   "phase_rad={:.4f}, readable={})")
            .format(row.distance_m, row.tag_dbm, row.reply_dbm, row.phase_rad, row.readable);
      });
  py::class_<AntennaLinks>(
      module, "Link",
      "An antenna at one moment: link(x_m, y_m, z_m) is the link to a tag there.\n\n"
      "Not for several threads at once: give each its own.")
      .def("__call__", &one_link, py::arg("x_m"), py::arg("y_m"), py::arg("z_m"),
           "The link to a tag at x, y, z [m, world], as a LinkState.")
      .def("batch", &batch, py::arg("positions_m"),
           "Links to tags at positions_m (N, 3) [m, world], as a table of N rows: distance_m,\n"
           "tag_dbm, reply_dbm, phase_rad, readable.");
  module.def("link", &links_from, py::arg("loaded"), py::arg("antenna"), py::arg("tag"),
             py::arg("time_s"), py::arg("tag_rpy_rad"));
}

}  // namespace tagfield::python
