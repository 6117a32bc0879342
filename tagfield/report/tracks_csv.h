// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tracks and orders as CSV.
#pragma once

#include <string>
#include <vector>

#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// `stamp_s,tag,track,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,` then the standard deviation of each of the
/// six: `sigma_x_m,…,sigma_vz_m_s`, and `cov_xy_m2`. One row per timestamp; `track` counts from 1,
/// the likeliest.
std::string tracks_to_csv(const std::vector<TagTrack>& tracks);

/// `tag,verdict,tracks,reads,left_out,rms_rad,coherence,expected_error_m,speed_m_s,heading_deg,
/// sigma_speed_m_s,sigma_heading_deg,reason`: one row per tag, of its likeliest track halfway.
std::string verdicts_to_csv(const std::vector<TagTrack>& tracks);

/// Only the rows of these tables, without headers.
std::string track_rows(const std::vector<TagTrack>& tracks);
std::string verdict_rows(const std::vector<TagTrack>& tracks);

/// `passed,rank,tag,stamp_s,sigma_s,before_next`: the last column is the probability that the tag
/// was before the next one, empty for the last tag.
std::string orders_to_csv(const std::vector<PassingOrder>& orders);

/// The orders in such a file. Throws Error "FILE:LINE: …" if it is malformed.
std::vector<PassingOrder> read_orders_csv(const std::string& path);

}  // namespace tagfield
