// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "apps/tagfield/scenario_arguments.h"
#include "python/core/arrays.h"
#include "python/core/loaded.h"
#include "tagfield/base/lane_math.h"
#include "tagfield/base/lanes.h"
#include "tagfield/base/random.h"
#include "tagfield/channel/paper_model.h"
#include "tagfield/channel/paper_signals.h"
#include "tagfield/channel/radio_world.h"
#include "tagfield/field/radio_port.h"
#include "tagfield/planning/link_explanation.h"
#include "tagfield/planning/moment.h"

namespace tagfield::python {
namespace {

/// Without a branch for each number: all bits of the exponent are set where one is not finite, and
/// one more carries into the sign.
void require_finite(std::span<const Eigen::Vector3d> places) {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000U;
  constexpr std::uint64_t kOne = 0x0010000000000000U;
  const std::span<const double> coordinates(places.front().data(), 3 * places.size());
  std::uint64_t carried = 0;
  for (const double x : coordinates) carried |= (bits_of(x) & kExponent) + kOne;
  if (carried >> 63U != 0) throw Error("link: a position must be three finite numbers [m]");
}

/// One antenna at one place, and the links to tags anywhere. Without noise.
class AntennaLinks {
 public:
  virtual ~AntennaLinks() = default;

  /// Into rows of the same length. Throws Error if a place is not finite.
  void links(std::span<const Eigen::Vector3d> places, std::span<LinkRow> rows) {
    for (std::size_t begin = 0; begin < places.size(); begin += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, places.size() - begin);
      const std::span<LinkRow> some = rows.subspan(begin, count);
      require_finite(places.subspan(begin, count));
      std::memset(some.data(), 0, some.size_bytes());  // The gaps after `readable` are saved, too.
      some_links(places.subspan(begin, count), some);
    }
  }

 protected:
  /// So few that all that is between places and rows stays in the L1 cache.
  static constexpr std::size_t kAtOnce = kStraightLinks;

 private:
  /// At most kAtOnce.
  virtual void some_links(std::span<const Eigen::Vector3d> places, std::span<LinkRow> rows) = 0;
};

class PaperLinksFrom final : public AntennaLinks {
 public:
  PaperLinksFrom(const PaperAntenna& antenna, const Eigen::Vector3d& p_WA)
      : antenna_(antenna), p_WA_(p_WA) {
    antenna_.model.phase_noise_rad = 0.0;
    antenna_.model.rssi_noise = 0.0;
  }

 private:
  void some_links(std::span<const Eigen::Vector3d> places, std::span<LinkRow> rows) override {
    const std::size_t count = places.size();
    for (std::size_t i = 0; i < count; ++i) {
      distance_m_[i] = link_between(p_WA_, places[i]).distance_m;
    }
    const std::span<const std::uint64_t> words(words_.data(), count);
    paper_signals(antenna_.model, {{distance_m_.data(), count}, words, words, {}},
                  {phase_rad_.data(), count}, {rssi_dbm_.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
      const bool readable =
          distance_m_[i] <= antenna_.range_m &&
          (!antenna_.sensitivity_dbm || rssi_dbm_[i] >= *antenna_.sensitivity_dbm);
      rows[i] = {distance_m_[i], kUnknown, rssi_dbm_[i], phase_rad_[i], readable};
    }
  }

  PaperAntenna antenna_;
  Eigen::Vector3d p_WA_;
  std::array<double, kAtOnce> distance_m_{}, phase_rad_{}, rssi_dbm_{};
  std::array<std::uint64_t, kAtOnce> words_{};  ///< Any, as there is no noise.
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
        is_empty_(is_empty_space(view_)),
        p_WA_(X_WA.translation),
        R_WT_(R_WT),
        key_(stream_key(tag.id)) {}

 private:
  /// One row is computed the same way as many, so that it equals that of a batch.
  void some_links(std::span<const Eigen::Vector3d> places, std::span<LinkRow> rows) override {
    const std::span<RadioLink> links(links_.data(), places.size());
    if (is_empty_) {
      add_straight(links, places);
    } else {
      add_traced(links, places);
    }
    reply_phases(view_, links, carrier_.phase_offset_rad, {phase_rad_.data(), places.size()});
    in_lanes(instruction_sets().back(), [&] { set_distances(places); });
    for (std::size_t i = 0; i < places.size(); ++i) {
      rows[i] = {distance_m_[i], links[i].tag_dbm, links[i].reply_dbm, phase_rad_[i],
                 is_heard(links[i], *tag_, model_)};
    }
  }
  void set_distances(std::span<const Eigen::Vector3d> places) {
    const double from_x = p_WA_.x();
    const double from_y = p_WA_.y();
    const double from_z = p_WA_.z();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double x = places[i].x() - from_x;
      const double y = places[i].y() - from_y;
      const double z = places[i].z() - from_z;
      distance_m_[i] = std::sqrt(x * x + (y * y + z * z));
    }
  }
  void add_straight(std::span<RadioLink> links, std::span<const Eigen::Vector3d> places) const {
    std::array<TagInView, kAtOnce> tags;
    for (std::size_t i = 0; i < places.size(); ++i) tags[i] = {tag_.get(), {&R_WT_, &places[i]}};
    straight_links_of(view_, {tags.data(), places.size()}, links);
  }
  void add_traced(std::span<RadioLink> links, std::span<const Eigen::Vector3d> places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      links[i] = link_of(view_, {*tag_, {R_WT_, places[i]}, key_}, paths_);
    }
  }

  LoadedPtr loaded_;
  const RadioModel& model_;
  std::shared_ptr<const TagModel> tag_;
  RadioPort port_;
  CarrierNow carrier_;
  RadioView view_;
  bool is_empty_;
  std::vector<RadioPath> paths_;
  std::array<RadioLink, kAtOnce> links_{};
  std::array<double, kAtOnce> distance_m_{}, phase_rad_{};
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

LinkRow one_link(AntennaLinks& self, double x_m, double y_m, double z_m) {
  const Eigen::Vector3d place(x_m, y_m, z_m);
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
  Rows<LinkRow> rows(positions_m.shape(0));  // NumPy's own memory, without a pass to clear it.
  const std::span<LinkRow> all(rows.mutable_data(), count);
  {
    const py::gil_scoped_release unlocked;
    self.links(places, all);
  }
  return as_table(rows, {});
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
           "Links to tags at positions_m (N, 3) [m, world], as a table of N rows:\n"
           "distance_m [m], tag_dbm and reply_dbm [dBm], phase_rad in [0, 2π) [rad], readable.\n"
           "A row equals link() of its position to the last bit.");
  module.def("link", &links_from, py::arg("loaded"), py::arg("antenna"), py::arg("tag"),
             py::arg("time_s"), py::arg("tag_rpy_rad"));
}

}  // namespace tagfield::python
