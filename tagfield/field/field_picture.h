/// @file
/// What a person wants to see of a field: tags, antennas, and how strongly each tag was read last.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/field/rfid_field.h"

namespace tagfield {

/// A colour, each part from 0 to 1.
struct ReadColor {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;
};

/// Colour of a read whose strength is `share` of the way from the weakest (0) to the strongest (1):
/// blue over green to red, weaker more transparent. Clamped; never fully transparent.
ReadColor read_color(double share);

/// Colour of a tag that was not read lately.
ReadColor silent_color();

/// An antenna as it was updated last.
struct SeenAntenna {
  std::string frame_id;
  RigidTransform X_WA;
  double range_m = 0.0;
};

/// Gathers what the listeners' events say and hands out a picture at intervals of simulated time.
class FieldPicture : public FieldListener {
 public:
  explicit FieldPicture(Duration interval) : interval_(interval) {}

  void tags_changed(Time stamp, const FieldTags& tags) final;
  void tags_moved(Time stamp, const std::vector<std::uint32_t>& slots, const FieldTags& tags) final;
  void antenna_updated(const AntennaUpdate& update) final;
  void antenna_added(const FieldAntenna&) final {}
  void antenna_removed(const std::string& antenna) final;

 protected:
  /// Called at intervals, with all tags present.
  virtual void draw(Time stamp, const FieldTags& tags) = 0;

  /// Colour of the tag in `slot` at `stamp`.
  [[nodiscard]] ReadColor color_of(std::uint32_t slot, Time stamp) const;
  [[nodiscard]] const std::map<std::string, SeenAntenna>& antennas() const { return antennas_; }

 private:
  struct Sight {
    Time stamp = Time::min();  ///< Of the last read.
    double rssi_dbm = 0.0;
  };
  void see(const AntennaUpdate& update);

  Duration interval_;
  Time drawn_ = Time::min();
  std::vector<Sight> sights_;         ///< By slot.
  std::vector<std::string> sighted_;  ///< The tags that `sights_` are of.
  std::map<std::string, SeenAntenna> antennas_;
  std::optional<double> weakest_dbm_;
  std::optional<double> strongest_dbm_;
};

}  // namespace tagfield
