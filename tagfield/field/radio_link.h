// SPDX-License-Identifier: Apache-2.0
/// @file
/// One antenna and one tag at one time: whether the tag is powered, whether its reply is received,
/// and with which phase. Eq. (1) of the paper in full; see docs/link_budget.md.
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

/// An antenna at one time, with everything that its links to the tags have in common.
struct RadioView {
  const RadioModel& model;
  const RadioWorld& world;
  Carrier carrier;
  TraceOptions tracing;
  RigidTransform X_WA;
  RigidTransform X_WR;  ///< Receiving antenna; X_WA if there is only one antenna.
  /// Of the antenna, and of a separate receiving antenna; null if each TagEnd has its own.
  std::shared_ptr<const ImageSet> images{};
  std::shared_ptr<const ImageSet> receiver_images{};
  std::uint64_t diffuse_key = 0;  ///< Distinguishes this antenna's diffuse waves from another's.
  std::uint64_t seed = 0;
  /// The world's edges; null without diffraction.
  const std::vector<DiffractingEdge>* edges = nullptr;
  std::vector<MovingBody> bodies{};  ///< At their current poses.
};

/// The view of an antenna at `X_WA` on a carrier, without images.
RadioView bare_view(const RadioModel& model, const RadioWorld& world, const RigidTransform& X_WA,
                    double frequency_hz, std::uint64_t diffuse_key, std::uint64_t seed);

/// Same, with the antenna's images.
RadioView view_from(const RadioModel& model, const RadioWorld& world, const RigidTransform& X_WA,
                    double frequency_hz, std::uint64_t diffuse_key, std::uint64_t seed);

/// A tag among neighbours: the weights with which the fields that they would receive alone reach
/// the tag's chip.
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

/// Cached data of the paths between one antenna and one tag in one world, which speed up the next
/// link but don't change it. At most 20 kB.
struct PathCache {
  struct Gain {
    double lambda_m = 0.0;
    std::complex<double> h = 0.0;
    Eigen::Vector3cd gradient = Eigen::Vector3cd::Zero();  ///< ∂h/∂p_WA.
    double power = 0.0;                                    ///< Σ |h_i|².
  };
  LastStops stops{};
  /// The last poses of both ends and, if these were the same the time before, their gains on each
  /// carrier.
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
  /// The tag's images, used instead of the antenna's if not null: the two ends must then be inside
  /// the same solids (shells_around()).
  const ImageSet* images = nullptr;
  /// Tags coupled with it; null for none. Paths to the neighbours are traced with the antenna's
  /// images.
  const TagSurroundings* around = nullptr;
  /// Caches of the paths from the view's antennas; null for none.
  PathCache* memory = nullptr;
  PathCache* receiver_memory = nullptr;
};

/// The powers of a link.
struct RadioLink {
  std::complex<double> forward;   ///< One-way amplitude gains;
  std::complex<double> backward;  ///< equal to `forward` with a single antenna.
  double tag_dbm = 0.0;           ///< At the chip.
  double reply_dbm = 0.0;         ///< At the reader's port.
  /// Rate of change of the phase of forward·backward per unit of velocity: its gradient with
  /// respect to the antenna's position [rad/m].
  Eigen::Vector3d phase_slope_W = Eigen::Vector3d::Zero();
};

/// For the view's antenna (its receiving one if `receiver` is set): the paths to `tag` over one
/// edge each, and the gain of one of them.
std::vector<DiffractedPath> diffracted_paths(const RadioView& view, const TagEnd& tag,
                                             bool receiver = false);
std::complex<double> gain_of(const DiffractedPath& path, const RadioView& view, const TagEnd& tag,
                             bool receiver = false);

/// The factor by which the view's bodies change a path's field.
std::complex<double> past_bodies(const RadioPath& path, const RadioView& view, const TagEnd& tag,
                                 bool receiver = false);

/// One-way amplitude gain between the view's receiving antenna and another reader's antenna, over
/// all paths of the view; `key` is the stream_key() of the other's name, `paths` workspace.
std::complex<double> gain_to_antenna(const RadioView& view, const AntennaPattern& other,
                                     const RigidTransform& X_WO, std::uint64_t key,
                                     std::vector<RadioPath>& paths);

/// Powers and gains; `paths` is workspace.
RadioLink link_of(const RadioView& view, const TagEnd& tag, std::vector<RadioPath>& paths);

/// Whether all of the view's waves propagate along direct paths in empty space, so that links of
/// many tags are computed together.
bool is_empty_space(const RadioView& view);

/// References to a tag in empty space, stored elsewhere.
struct TagInView {
  const TagModel* model;
  PoseRef pose;
};

/// link_of() for each of the tags, in empty space, into `links` of the same length; bit-identical
/// whatever else is in the batch. Fastest if tags of the same model are consecutive.
void straight_links_of(const RadioView& view, std::span<const TagInView> tags,
                       std::span<RadioLink> links);

/// link_of() for each of the tags, into `links` of the same length; in batches if waves propagate
/// along direct paths in empty space. Bit-identical whatever else is in the batch.
void links_of(const RadioView& view, std::span<const TagEnd> tags, std::vector<RadioPath>& paths,
              std::span<RadioLink> links);

/// Margins [dB]: power above the required minimum.
inline double tag_margin_db(const RadioLink& link, const TagModel& tag) {
  return link.tag_dbm - tag.sensitivity_dbm;
}
inline double reader_margin_db(const RadioLink& link, const RadioModel& model) {
  return link.reply_dbm - model.hardware.sensitivity_dbm;
}

/// Whether the tag responds and the reader receives the reply.
inline bool is_heard(const RadioLink& link, const TagModel& tag, const RadioModel& model) {
  return tag_margin_db(link, tag) >= 0.0 && reader_margin_db(link, model) >= 0.0;
}

/// The reply at the receiver's input: phase −arg(h·h') plus offset, power, and Doppler for an
/// antenna that moves at `v_AT_W` relative to the tag [m/s].
Reply reply_of(const RadioLink& link, double phase_offset_rad, const Eigen::Vector3d& v_AT_W);

/// The phase of reply_of() for each of the view's links, wrapped to [0, 2π), into `phase_rad` of
/// the same length, many at a time: equal up to the last digits. Bit-identical whatever else is in
/// the batch and whatever the instruction set.
void reply_phases(const RadioView& view, std::span<const RadioLink> links, double phase_offset_rad,
                  std::span<double> phase_rad, InstructionSet set = instruction_sets().back());

}  // namespace tagfield
