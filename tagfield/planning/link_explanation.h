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

/// One antenna, one tag, where they are at a moment.
struct LinkQuestion {
  const AntennaSpec& antenna;
  const TagSpec& tag;
  Time time;
  RigidTransform X_WA;
  RigidTransform X_WT;
  std::uint64_t seed = 1;
  std::vector<MovingBody> bodies{};  ///< What moves, where it is then.
};

/// By the paper's model: range and the means of eqs. (4) and (5).
struct PaperLink {
  double range_m = 0.0;
  double perturbed_range_m = 0.0;  ///< In the antenna's last update up to the moment.
  Time update;                     ///< When that was.
  double read_probability = 0.0;   ///< In any one update.
  double phase_rad = 0.0;          ///< Without noise, in [0, 2π).
  double rssi_dbm = 0.0;           ///< Likewise.
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
  double snr_db = 0.0;           ///< Of the reply in the receiver's bandwidth.
  double phase_rad = 0.0;        ///< Without noise, offsets of channel and port in it; in [0, 2π).
  double phase_sigma_rad = 0.0;  ///< Expected standard deviation of the reported phase.
  std::size_t channel = 0;       ///< Index into the plan.
  double frequency_hz = 0.0;
  bool takes_inventory = false;
  std::optional<Time> turn;  ///< With an inventory: when the antenna's turn begins, or now.
  std::optional<double> decode_probability;   ///< With an inventory, of a slot of its own.
  std::vector<PathExplanation> paths;         ///< From the sending antenna, as explain_paths().
  std::vector<MaterialOnLink> materials;      ///< Of all that `paths` meet, by name.
  std::vector<SurfaceOnPath> between;         ///< On the direct way there.
  std::vector<SurfaceOnPath> between_return;  ///< Back to a receiving antenna of its own.

  [[nodiscard]] double tag_margin_db() const { return tag_dbm - tag_sensitivity_dbm; }
  [[nodiscard]] double reader_margin_db() const { return reply_dbm - reader_sensitivity_dbm; }
  [[nodiscard]] bool heard() const { return tag_margin_db() >= 0.0 && reader_margin_db() >= 0.0; }
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
};

/// Explains one link of `scenario`, whose antennas share readers, channels and turns.
LinkExplanation explain_link(const Scenario& scenario, const LinkQuestion& question);

/// Share of an antenna's updates in which its perturbed range (see perturbed_range()) is at least
/// `distance_m`, by the paper's model: P(r·|1 + σr·n| ≥ D).
double read_probability(const AntennaParameters& antenna, double distance_m);

/// The channel, turn and keys of an antenna among all of the scenario's.
RadioPort port_of(const Scenario& scenario, const AntennaParameters& antenna, std::uint64_t seed);

/// Sum of all lines [dB or dBm].
double sum_of(const std::vector<BudgetLine>& lines);

}  // namespace tagfield
