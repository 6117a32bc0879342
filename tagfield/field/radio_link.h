// SPDX-License-Identifier: Apache-2.0
/// @file
/// One antenna, one tag, now: is it powered, is it heard, and with which phase. Eq. (1) of the
/// paper in full; see docs/link_budget.md.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/channel/diffracted_gain.h"
#include "tagfield/channel/free_space_gains.h"
#include "tagfield/channel/moving_body.h"
#include "tagfield/channel/path_gain.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {

/// An antenna at one moment, with all that its links to the tags have in common.
struct RadioView {
  const RadioModel& model;
  const RadioWorld& world;
  Carrier carrier;
  TraceOptions tracing;
  RigidTransform X_WA;
  RigidTransform X_WR;  ///< Receiving antenna; X_WA where it is one and the same.
  /// Of the antenna, and of the receiving one where it is another; null where each TagEnd brings
  /// its own.
  std::shared_ptr<const ImageSet> images{};
  std::shared_ptr<const ImageSet> receiver_images{};
  std::uint64_t diffuse_key = 0;  ///< Tells this antenna's diffuse waves from another's.
  std::uint64_t seed = 0;
  /// The world's edges; null where waves don't bend.
  const std::vector<DiffractingEdge>* edges = nullptr;
  std::vector<MovingBody> bodies{};  ///< Where they are now.
};

/// The view of an antenna at `X_WA` on a carrier, without images.
RadioView bare_view(const RadioModel& model, const RadioWorld& world, const RigidTransform& X_WA,
                    double frequency_hz, std::uint64_t diffuse_key, std::uint64_t seed);

/// Likewise with the antenna's images.
RadioView view_from(const RadioModel& model, const RadioWorld& world, const RigidTransform& X_WA,
                    double frequency_hz, std::uint64_t diffuse_key, std::uint64_t seed);

/// A tag among neighbours: of the field that each takes in alone, what gets to the tag's chip.
struct TagSurroundings {
  struct Neighbour {
    const TagModel* model = nullptr;
    RigidTransform X_WT;
    std::uint64_t key = 0;  ///< stream_key() of its ID.
    std::complex<double> share;
  };
  std::complex<double> own = 1.0;
  std::vector<Neighbour> neighbours;
};

/// Of the way from one antenna to one tag, in one world: what makes the next link quicker, not
/// different. At most 20 kB.
struct WayMemory {
  struct Gain {
    double lambda_m = 0.0;
    std::complex<double> h = 0.0;
    Eigen::Vector3cd gradient = Eigen::Vector3cd::Zero();  ///< ∂h/∂p_WA.
    double power = 0.0;                                    ///< Σ |h_i|².
  };
  LastStops stops{};
  /// The ends as they were last, and if they were there before, their gains on each carrier.
  RigidTransform X_WA{};
  RigidTransform X_WT{};
  const TagModel* kind = nullptr;
  const ImageSet* tag_images = nullptr;
  std::vector<Gain> gains{};
};

/// The tag's end of a link.
struct TagEnd {
  const TagModel& model;
  RigidTransform X_WT;
  std::uint64_t key = 0;  ///< stream_key() of its ID.
  /// The tag's images, to be used instead of the antenna's where they are known: the two ends must
  /// then be in the same solids (shells_around()).
  const ImageSet* images = nullptr;
  /// What couples with it; null where nothing does. The neighbours are seen by the antenna's
  /// images.
  const TagSurroundings* around = nullptr;
  /// What is known of the link's ways from the view's antennas from before; null where nothing is.
  WayMemory* memory = nullptr;
  WayMemory* receiver_memory = nullptr;
};

/// A link's powers.
struct RadioLink {
  std::complex<double> forward;   ///< Amplitude gains, one way;
  std::complex<double> backward;  ///< the same as `forward` with one antenna.
  double tag_dbm = 0.0;           ///< At the chip.
  double reply_dbm = 0.0;         ///< At the reader's port.
  /// How fast the phase of forward·backward grows with time for a unit of speed: its gradient with
  /// the antenna's place [rad/m].
  Eigen::Vector3d phase_slope_W = Eigen::Vector3d::Zero();
};

/// Of the view's antenna (its receiving one where `receiver` is set): the ways to `tag` over an
/// edge each, and the gain of one.
std::vector<DiffractedPath> diffracted_paths(const RadioView& view, const TagEnd& tag,
                                             bool receiver = false);
std::complex<double> gain_of(const DiffractedPath& path, const RadioView& view, const TagEnd& tag,
                             bool receiver = false);

/// What the view's bodies leave of a path's field, as a factor.
std::complex<double> past_bodies(const RadioPath& path, const RadioView& view, const TagEnd& tag,
                                 bool receiver = false);

/// One-way amplitude gain from the view's receiving antenna to another reader's, or back, by all
/// ways of the view; `key` is the stream_key() of the other's name, `paths` workspace.
std::complex<double> gain_to_antenna(const RadioView& view, const AntennaPattern& other,
                                     const RigidTransform& X_WO, std::uint64_t key,
                                     std::vector<RadioPath>& paths);

/// Powers and gains; `paths` is workspace.
RadioLink link_of(const RadioView& view, const TagEnd& tag, std::vector<RadioPath>& paths);

/// Whether all of the view's waves go straight through empty space, so that links of many tags are
/// computed together.
bool is_empty_space(const RadioView& view);

/// A tag in empty space, by what is kept of it elsewhere.
struct TagInView {
  const TagModel* model;
  PoseRef pose;
};

/// link_of() of each of the tags, in empty space, into `links` of the same length; the same bits
/// whatever else is in the batch. Quickest where tags of one model follow each other.
void straight_links_of(const RadioView& view, std::span<const TagInView> tags,
                       std::span<RadioLink> links);

/// link_of() of each of the tags, into `links` of the same length: many at a time where waves go
/// straight through empty space. The same bits whatever else is in the batch.
void links_of(const RadioView& view, std::span<const TagEnd> tags, std::vector<RadioPath>& paths,
              std::span<RadioLink> links);

/// Margins [dB]: what there is beyond what it takes.
inline double tag_margin_db(const RadioLink& link, const TagModel& tag) {
  return link.tag_dbm - tag.sensitivity_dbm;
}
inline double reader_margin_db(const RadioLink& link, const RadioModel& model) {
  return link.reply_dbm - model.hardware.sensitivity_dbm;
}

/// Whether the tag answers and the reader hears it.
inline bool is_heard(const RadioLink& link, const TagModel& tag, const RadioModel& model) {
  return tag_margin_db(link, tag) >= 0.0 && reader_margin_db(link, model) >= 0.0;
}

/// What comes in of a link before the receiver adds its own: phase −arg(h·h') and offset, power,
/// and Doppler for an antenna that moves at `v_AT_W` against the tag [m/s].
Reply reply_of(const RadioLink& link, double phase_offset_rad, const Eigen::Vector3d& v_AT_W);

}  // namespace tagfield
