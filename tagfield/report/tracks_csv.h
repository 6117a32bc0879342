// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tracks and orders as CSV.
#pragma once

#include <string>
#include <vector>

#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// `stamp_s,tag,track,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,` then the standard deviation of each of
/// the six: `sigma_x_m,…,sigma_vz_m_s`, and `cov_xy_m2`. A row a stamp; `track` counts from 1, the
/// likeliest.
std::string tracks_to_csv(const std::vector<TagTrack>& tracks);

/// `tag,verdict,tracks,reads,left_out,rms_rad,coherence,expected_error_m,speed_m_s,heading_deg,
/// sigma_speed_m_s,sigma_heading_deg,reason`: a row a tag, of its likeliest track halfway.
std::string verdicts_to_csv(const std::vector<TagTrack>& tracks);

/// The rows of these tables alone, to be added to a header.
std::string track_rows(const std::vector<TagTrack>& tracks);
std::string verdict_rows(const std::vector<TagTrack>& tracks);

/// `passed,rank,tag,stamp_s,sigma_s,before_next`: the last is the probability that the tag was
/// before the one that follows, empty for the last.
std::string orders_to_csv(const std::vector<PassingOrder>& orders);

/// The orders in such a file. Throws Error "FILE:LINE: …" on what is none.
std::vector<PassingOrder> read_orders_csv(const std::string& path);

}  // namespace tagfield
