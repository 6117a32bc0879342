// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whom a server on somebody's machine answers.
#pragma once

#include <string>
#include <string_view>

namespace tagfield::http {

/// Whether a request's Host header names this machine: an IP address, localhost or `own_name`, with
/// a port or without. A site elsewhere that has its name point here (DNS rebinding) does not.
bool is_own_host(std::string_view host, std::string_view own_name);

/// Whether a request with this Origin header ("" for none) comes from our own page, or from no page
/// at all.
bool is_own_origin(std::string_view origin, std::string_view host);

/// Whether both are the same, in a time that does not tell how much of them is.
bool is_same_secret(std::string_view given, std::string_view secret);

/// 128 bits at random as hexadecimal digits, of the system's generator.
std::string new_token();

}  // namespace tagfield::http
