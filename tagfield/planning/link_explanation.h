// SPDX-License-Identifier: Apache-2.0
/// @file
/// Why a tag is read or not by an antenna at one moment. docs/explain.md says what the figures
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

/// A line of a link budget; all lines of one add up.
struct BudgetLine {
  std::string what;  ///< For people: "free space over 4.12 m".
  double db = 0.0;   ///< Gain, below 0 for a loss [dB]; of the first line a power [dBm].
};

/// What something on a link's paths is made of, as waves see it at the link's carrier.
struct MaterialOnLink {
  std::string name;
  double permittivity = 1.0;      ///< Relative, its real part.
  double conductivity_s_m = 0.0;  ///< [S/m]
  double least_ghz = 0.0;         ///< Where its coefficients were measured,
  double most_ghz = 0.0;          ///< infinity where nobody says.
  bool is_measured_here = true;   ///< The carrier lies between these.
};

/// A tag beside the one asked about, and an antenna beside.
struct OtherTag {
  const TagSpec& tag;
  RigidTransform X_WT;
};
struct OtherAntenna {
  const AntennaSpec& antenna;
  RigidTransform X_WA;
};

/// One antenna, one tag, where they are at a moment.
struct LinkQuestion {
  const AntennaSpec& antenna;
  const TagSpec& tag;
  Time time;
  RigidTransform X_WA;
  RigidTransform X_WT;
  std::uint64_t seed = 1;
  std::vector<MovingBody> bodies{};    ///< What moves, where it is then.
  std::vector<OtherTag> other_tags{};  ///< Present then.
  std::vector<OtherAntenna> other_antennas{};
};

/// By the paper's model: range and the means of eqs. (4) and (5).
struct PaperLink {
  double range_m = 0.0;
  double perturbed_range_m = 0.0;           ///< In the antenna's last update up to the moment.
  Time update;                              ///< When that was.
  double read_probability = 0.0;            ///< In any one update.
  double phase_rad = 0.0;                   ///< Without noise, in [0, 2π).
  double rssi_dbm = 0.0;                    ///< Likewise.
  std::optional<double> sensitivity_dbm{};  ///< Of the antenna, where it has one.
};

/// A tag that couples with the one asked about.
struct NearTag {
  std::string id;
  double distance_m = 0.0;
  double alone_db = 0.0;  ///< What it would do to the field at the chip, were it the only one.
};

/// Another reader's antenna that sends at the moment.
struct InterferingReader {
  std::string reader;
  std::string antenna;
  double offset_hz = 0.0;       ///< Of its carrier from the link's.
  double time_share = 1.0;      ///< Of its time in which it sends.
  double received_dbm = 0.0;    ///< At the reader's port,
  double in_replies_dbm = 0.0;  ///< and what of it comes through with the reply.
  double at_tag_dbm = 0.0;      ///< At the chip.
};

/// What other readers do to a link whose antenna minds them.
struct LinkInterference {
  std::vector<InterferingReader> by;
  double noise_dbm = 0.0;  ///< The receiver's own,
  double total_dbm = 0.0;  ///< and all others', in the reply's bandwidth.
  double sinr_db = 0.0;    ///< The reply over both.
  double required_sinr_db = 0.0;
  double capture_db = 0.0;  ///< The own carrier over all others at the chip,
  double required_capture_db = 0.0;

  [[nodiscard]] bool tag_hears() const { return by.empty() || capture_db >= required_capture_db; }
  [[nodiscard]] bool reader_hears() const { return by.empty() || sinr_db >= required_sinr_db; }
};

/// By a physical model.
struct PhysicalLink {
  std::vector<BudgetLine> to_tag;     ///< From the reader's port to the chip: tag_dbm.
  std::vector<BudgetLine> to_reader;  ///< From the chip back to the port: reply_dbm.
  bool arrives = false;               ///< Whether anything gets to the tag and back at all.
  double tag_dbm = 0.0;               ///< At the chip,
  double tag_sensitivity_dbm = 0.0;   ///< against this.
  double reply_dbm = 0.0;             ///< At the reader's port,
  double reader_sensitivity_dbm = 0.0;
  double snr_db = 0.0;     ///< Of the reply in the receiver's bandwidth, without other readers.
  double phase_rad = 0.0;  ///< Without noise, offsets of channel and port in it; in [0, 2π).
  double phase_sigma_rad = 0.0;  ///< Expected standard deviation of the reported phase.
  std::size_t channel = 0;       ///< Index into the plan.
  double frequency_hz = 0.0;
  bool takes_inventory = false;
  std::optional<Time> turn;  ///< With an inventory: when the antenna's turn begins, or now.
  std::optional<double> decode_probability;      ///< With an inventory, of a slot of its own.
  std::vector<PathExplanation> paths;            ///< From the sending antenna, as explain_paths().
  std::vector<MaterialOnLink> materials;         ///< Of all that `paths` meet, by name.
  std::vector<NearTag> near_tags;                ///< That couple, by rising distance.
  std::optional<LinkInterference> interference;  ///< Where the antenna minds other readers.
  std::vector<SurfaceOnPath> between;            ///< On the direct way there.
  std::vector<SurfaceOnPath> between_return;     ///< Back to a receiving antenna of its own.

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
  std::string absent;              ///< Why the tag is not there; "" where it is.
  bool read = false;               ///< Whether it can be read at this moment.
  std::string verdict;             ///< "not read: −3.1 dB at the tag, behind rack_4 (metal)".
  std::optional<PaperLink> paper;  ///< Either this
  std::optional<PhysicalLink> physical;  ///< or that.
  std::size_t antennas_compared = 1;     ///< Of which this one has the most to spare.
};

/// Explains one link of `scenario`, whose antennas share readers, channels and turns.
LinkExplanation explain_link(const Scenario& scenario, const LinkQuestion& question);

/// Share of an antenna's updates in which its perturbed range (see perturbed_range()) is at least
/// `distance_m`, by the paper's model: P(r·|1 + σr·n| ≥ D); and of those the share whose RSSI is at
/// least the antenna's sensitivity, where it has one: P(|G·λ/(4πD) + n_RSSI| ≥ 10^((s − ½)/40)).
double read_probability(const AntennaParameters& antenna, double distance_m);

/// Those that share the air.
std::vector<AntennaParameters> physical_antennas(const Scenario& scenario);

/// The channel, turn and keys of an antenna among all of the scenario's.
RadioPort port_of(const Scenario& scenario, const AntennaParameters& antenna, std::uint64_t seed);

/// Sum of all lines [dB or dBm].
double sum_of(const std::vector<BudgetLine>& lines);

}  // namespace tagfield
