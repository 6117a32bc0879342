// SPDX-License-Identifier: Apache-2.0
/// @file
/// Why a tag is or is not read by an antenna at one moment. docs/explain.md says what the numbers
/// mean.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/field/radio_port.h"
#include "tagfield/planning/path_explanation.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// A line of a link budget. The lines of a budget add up to its result.
struct BudgetLine {
  std::string what;  ///< For people: "free space over 4.12 m".
  double db = 0.0;   ///< Gain, negative for a loss [dB]; the first line is a power [dBm].
};

/// A material met by a link's paths, with its properties at the link's carrier.
struct MaterialOnLink {
  std::string name;
  double permittivity = 1.0;      ///< Real part of the relative permittivity.
  double conductivity_s_m = 0.0;  ///< [S/m]
  double min_ghz = 0.0;           ///< Range in which its coefficients were measured,
  double max_ghz = 0.0;           ///< infinity if unknown.
  bool is_measured_here = true;   ///< Whether the carrier lies within this range.
};

/// Another tag, and another antenna, besides those of the question.
struct OtherTag {
  const TagSpec& tag;
  RigidTransform X_WT;
};
struct OtherAntenna {
  const AntennaSpec& antenna;
  RigidTransform X_WA;
};

/// One antenna and one tag, with their poses at a moment.
struct LinkQuestion {
  const AntennaSpec& antenna;
  const TagSpec& tag;
  Time time;
  RigidTransform X_WA;
  RigidTransform X_WT;
  std::uint64_t seed = 1;
  std::vector<MovingBody> bodies{};    ///< Moving objects, at their poses then.
  std::vector<OtherTag> other_tags{};  ///< Present then.
  std::vector<OtherAntenna> other_antennas{};
};

/// A link by the paper's model: range and the means of eqs. (4) and (5).
struct PaperLink {
  double range_m = 0.0;
  double perturbed_range_m = 0.0;  ///< In the antenna's last update before or at the moment.
  Time update;                     ///< Time of that update.
  double read_probability = 0.0;   ///< In any single update.
  double phase_rad = 0.0;          ///< Without noise, in [0, 2π).
  double rssi_dbm = 0.0;           ///< Also without noise.
  std::optional<double> sensitivity_dbm{};  ///< Of the antenna, if it has one.
};

/// A tag that couples with that of the question.
struct NearTag {
  std::string id;
  double distance_m = 0.0;
  double alone_db = 0.0;  ///< Its effect on the field at the chip if it were the only such tag.
};

/// Another reader's antenna that transmits at the moment.
struct InterferingReader {
  std::string reader;
  std::string antenna;
  double offset_hz = 0.0;       ///< Offset of its carrier from the link's.
  double time_share = 1.0;      ///< Fraction of time in which it transmits.
  double received_dbm = 0.0;    ///< At the reader's port,
  double in_replies_dbm = 0.0;  ///< and within the bandwidth of the reply.
  double at_tag_dbm = 0.0;      ///< At the chip.
};

/// Interference by other readers on a link whose antenna models them.
struct LinkInterference {
  std::vector<InterferingReader> by;
  double noise_dbm = 0.0;  ///< The receiver's own noise, and
  double total_dbm = 0.0;  ///< that plus all interference, in the reply's bandwidth.
  double sinr_db = 0.0;    ///< The reply over that total.
  double required_sinr_db = 0.0;
  double capture_db = 0.0;  ///< The antenna's own carrier over all others at the chip,
  double required_capture_db = 0.0;

  [[nodiscard]] bool tag_hears() const { return by.empty() || capture_db >= required_capture_db; }
  [[nodiscard]] bool reader_hears() const { return by.empty() || sinr_db >= required_sinr_db; }
};

/// A link by a physical model.
struct PhysicalLink {
  std::vector<BudgetLine> to_tag;     ///< From the reader's port to the chip: tag_dbm.
  std::vector<BudgetLine> to_reader;  ///< From the chip back to the port: reply_dbm.
  bool arrives = false;               ///< Whether any power gets to the tag and back at all.
  double tag_dbm = 0.0;               ///< At the chip,
  double tag_sensitivity_dbm = 0.0;   ///< against this.
  double reply_dbm = 0.0;             ///< At the reader's port,
  double reader_sensitivity_dbm = 0.0;
  double snr_db = 0.0;     ///< Of the reply in the receiver's bandwidth, without interference.
  double phase_rad = 0.0;  ///< Without noise, but with channel and port offsets; in [0, 2π).
  double phase_sigma_rad = 0.0;  ///< Expected standard deviation of the reported phase.
  std::size_t channel = 0;       ///< Index into the plan.
  double frequency_hz = 0.0;
  bool takes_inventory = false;
  std::optional<Time> turn;  ///< With an inventory: when the antenna's next turn begins, or now.
  std::optional<double> decode_probability;  ///< With an inventory: in a slot without collision.
  std::vector<PathExplanation> paths;     ///< From the transmitting antenna, as by explain_paths().
  std::vector<MaterialOnLink> materials;  ///< Materials that `paths` meet, sorted by name.
  std::vector<NearTag> near_tags;         ///< Coupled tags, sorted by distance.
  std::optional<LinkInterference> interference;  ///< Set if the antenna models other readers.
  std::vector<SurfaceOnPath> between;            ///< Obstacles on the direct path to the tag.
  std::vector<SurfaceOnPath> between_return;     ///< To a separate receiving antenna.

  [[nodiscard]] double tag_margin_db() const { return tag_dbm - tag_sensitivity_dbm; }
  [[nodiscard]] double reader_margin_db() const { return reply_dbm - reader_sensitivity_dbm; }
  [[nodiscard]] bool has_power() const {
    return tag_margin_db() >= 0.0 && reader_margin_db() >= 0.0;
  }
  [[nodiscard]] bool heard() const {
    return has_power() &&
           (!interference || (interference->tag_hears() && interference->reader_hears()));
  }
};

struct LinkExplanation {
  std::string antenna;
  std::string reader;
  std::string tag;
  Time time;
  RigidTransform X_WA;
  RigidTransform X_WT;
  double distance_m = 0.0;
  std::string absent;              ///< Why the tag is absent; "" if it is present.
  bool read = false;               ///< Whether it can be read at this moment.
  std::string verdict;             ///< "not read: −3.1 dB at the tag, behind rack_4 (metal)".
  std::optional<PaperLink> paper;  ///< Either this
  std::optional<PhysicalLink> physical;  ///< or that.
  std::size_t antennas_compared = 1;     ///< Of which this one has the best link.
};

/// Explains one link of `scenario`; its other antennas matter, as they share readers, channels and
/// turns.
LinkExplanation explain_link(const Scenario& scenario, const LinkQuestion& question);

/// Fraction of an antenna's updates in which its perturbed range (see perturbed_range()) is at
/// least `distance_m`, by the paper's model: P(r·|1 + σr·n| ≥ D); multiplied, if the antenna has a
/// sensitivity, by the fraction of those whose RSSI reaches it: P(|G·λ/(4πD) + n_RSSI| ≥ 10^((s −
/// ½)/40)).
double read_probability(const AntennaParameters& antenna, double distance_m);

/// The antennas with a physical model, which share the air.
std::vector<AntennaParameters> physical_antennas(const Scenario& scenario);

/// The channel, turn and keys of an antenna among all antennas of the scenario.
RadioPort port_of(const Scenario& scenario, const AntennaParameters& antenna, std::uint64_t seed);

/// Sum of all lines [dB or dBm].
double sum_of(const std::vector<BudgetLine>& lines);

}  // namespace tagfield
