// SPDX-License-Identifier: Apache-2.0
/// @file
/// Cyclone DDS, loaded on the first use of ROS 2.
#pragma once

#include <dds/dds.h>

#include "tagfield/base/loaded_library.h"

namespace tagfield::ros2 {

/// Functions of Cyclone DDS, named without the prefix "dds_".
struct LibDds : LoadedLibrary {
  LibDds() : LoadedLibrary("ROS 2", TAGFIELD_LIBDDSC) {}
  decltype(&dds_create_domain) create_domain = function("dds_create_domain");
  decltype(&dds_create_participant) create_participant = function("dds_create_participant");
  decltype(&dds_create_qos) create_qos = function("dds_create_qos");
  decltype(&dds_create_reader) create_reader = function("dds_create_reader");
  decltype(&dds_create_topic) create_topic = function("dds_create_topic");
  decltype(&dds_create_writer) create_writer = function("dds_create_writer");
  decltype(&dds_delete) delete_ = function("dds_delete");
  decltype(&dds_delete_qos) delete_qos = function("dds_delete_qos");
  decltype(&dds_free) free = function("dds_free");
  decltype(&dds_get_guid) get_guid = function("dds_get_guid");
  decltype(&dds_get_publication_matched_status) get_publication_matched_status =
      function("dds_get_publication_matched_status");
  decltype(&dds_lookup_participant) lookup_participant = function("dds_lookup_participant");
  decltype(&dds_qset_data_representation) qset_data_representation =
      function("dds_qset_data_representation");
  decltype(&dds_qset_durability) qset_durability = function("dds_qset_durability");
  decltype(&dds_qset_history) qset_history = function("dds_qset_history");
  decltype(&dds_qset_reliability) qset_reliability = function("dds_qset_reliability");
  decltype(&dds_qset_userdata) qset_userdata = function("dds_qset_userdata");
  decltype(&dds_return_loan) return_loan = function("dds_return_loan");
  decltype(&dds_set_log_sink) set_log_sink = function("dds_set_log_sink");
  decltype(&dds_strretcode) strretcode = function("dds_strretcode");
  decltype(&dds_take) take = function("dds_take");
  decltype(&dds_time) time = function("dds_time");
  decltype(&dds_wait_for_acks) wait_for_acks = function("dds_wait_for_acks");
  decltype(&dds_write) write = function("dds_write");
};

inline const LibDds& libdds() { return loaded<LibDds>(); }

}  // namespace tagfield::ros2
