// SPDX-License-Identifier: Apache-2.0
/// @file
/// libcurl, loaded when it is first needed: linking it would load two dozen libraries, and make
/// each start an eighth longer, in a program that hardly ever posts anything.
#pragma once

#include <curl/curl.h>

#include "tagfield/base/loaded_library.h"

namespace tagfield {

/// Functions of libcurl, named without the prefix "curl_".
struct LibCurl : LoadedLibrary {
  LibCurl();
  decltype(&curl_global_init) global_init = function("curl_global_init");
  decltype(&curl_easy_init) easy_init = function("curl_easy_init");
  decltype(&::curl_easy_setopt) easy_setopt = function("curl_easy_setopt");
  decltype(&::curl_easy_getinfo) easy_getinfo = function("curl_easy_getinfo");
  decltype(&curl_easy_strerror) easy_strerror = function("curl_easy_strerror");
  decltype(&curl_easy_cleanup) easy_cleanup = function("curl_easy_cleanup");
  decltype(&curl_multi_init) multi_init = function("curl_multi_init");
  decltype(&curl_multi_add_handle) multi_add_handle = function("curl_multi_add_handle");
  decltype(&curl_multi_perform) multi_perform = function("curl_multi_perform");
  decltype(&curl_multi_poll) multi_poll = function("curl_multi_poll");
  decltype(&curl_multi_info_read) multi_info_read = function("curl_multi_info_read");
  decltype(&curl_multi_remove_handle) multi_remove_handle = function("curl_multi_remove_handle");
  decltype(&curl_multi_cleanup) multi_cleanup = function("curl_multi_cleanup");
  decltype(&curl_slist_append) slist_append = function("curl_slist_append");
  decltype(&curl_slist_free_all) slist_free_all = function("curl_slist_free_all");
  decltype(&curl_url) url = function("curl_url");
  decltype(&curl_url_set) url_set = function("curl_url_set");
  decltype(&curl_url_cleanup) url_cleanup = function("curl_url_cleanup");
};

/// The library, loaded and initialized on the first call; it stays loaded until the process ends.
/// Callable from any thread. Throws Error if it is not installed.
const LibCurl& libcurl();

}  // namespace tagfield
